"""bindpose render draws meshes with the materials, textures and vertex colors of their files."""

import base64
import json
import struct

import foreign_rig
import numpy as np
import pytest
import shapes
from gltf_file import GltfFile
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

WHITE, RED, GREEN, BLUE, YELLOW = (255, 255, 255), (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0)
UNLIT = {"KHR_materials_unlit": {}}
# A JPEG file of 8 x 8 pixels with the gray value 100.
GRAY_JPEG = (
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAIBAQEBAQIBAQECAgICAgQDAgICAgUEBAMEBgUGBgYFBgYGBwkIBgcJBwYGCAsICQoK"
    "CgoKBggLDAsKDAkKCgr/wgALCAAIAAgBAREA/8QAFAABAAAAAAAAAAAAAAAAAAAABv/aAAgBAQAAAAEP/8QAFBABAAAAAAAAAAAA"
    "AAAAAAAAAP/aAAgBAQABBQJ//8QAFBABAAAAAAAAAAAAAAAAAAAAAP/aAAgBAQAGPwJ//8QAFBABAAAAAAAAAAAAAAAAAAAAAP/a"
    "AAgBAQABPyF//9oACAEBAAAAEH//xAAUEAEAAAAAAAAAAAAAAAAAAAAA/9oACAEBAAE/EH//2Q==")
NEAREST = [{"magFilter": 9728, "minFilter": 9728, "wrapS": 33071, "wrapT": 33071}]


def pixels_of(path):
    """Return the pixels of a picture, #rows x #columns x 3. Row 0 is at the top."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)[::-1, :, :3]


def at(pixels, x, y):
    """Return the color at a position in the square that fills the middle of the picture; (0, 0) is its upper left
    corner."""
    rows, columns, _ = pixels.shape
    inside = [i for i in range(columns) if tuple(pixels[rows // 2, i]) != WHITE]
    left, size = inside[0], inside[-1] - inside[0]
    top = (rows - size) // 2
    return tuple(int(c) for c in pixels[round(top + y * size), round(left + x * size)])


def four_colors(x, y):
    return ((*RED, 255), (*GREEN, 255), (*BLUE, 255), (*YELLOW, 255))[2 * y + x]


def write_square(folder, material, picture=None, name="square.gltf", uri=None, **more):
    """Write a square that faces the camera. Its texture coordinates show the whole picture upright."""
    buffer = foreign_rig.Buffer()
    attributes = {"POSITION": buffer.add([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "VEC3"),
                  "NORMAL": buffer.add([[0, 0, 1]] * 4, "VEC3"),
                  "TEXCOORD_0": buffer.add(more.get("coordinates", [[0, 1], [1, 1], [1, 0], [0, 0]]), "VEC2")}
    if "colors" in more:
        attributes["COLOR_0"] = buffer.add(more["colors"], "VEC4")
    file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": attributes, "material": 0,
                                        "indices": buffer.add([0, 1, 2, 0, 2, 3], "SCALAR", "H")}]}],
            "materials": [material], "extensionsUsed": ["KHR_materials_unlit"]}
    if picture:
        uri = uri or f"data:image/{more.get('kind', 'png')};base64," + base64.b64encode(picture).decode()
        file.update(images=[{"uri": uri}], samplers=more.get("samplers", NEAREST), textures=[{"source": 0, "sampler": 0}])
    folder.write(name, json.dumps(buffer.complete(file)))


def unlit_picture(**more):
    return {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, **more}}, "extensions": UNLIT}


def render(folder, name="square.gltf", *words):
    run = folder.run("render", name, "--size", "200x160", *words, "-o", "p.png", "--overwrite").is_good()
    return pixels_of(folder / "p.png"), run


def test_an_unlit_texture_is_drawn_exactly_and_upright(folder):
    write_square(folder, unlit_picture(), shapes.png(2, 2, four_colors))
    pixels, _ = render(folder)
    assert [at(pixels, x, y) for y in (0.25, 0.75) for x in (0.25, 0.75)] == [RED, GREEN, BLUE, YELLOW]


@pytest.mark.parametrize("columns, rows", [(1, 4), (4, 1)])
def test_pictures_of_one_row_or_column(folder, columns, rows):
    colors = [RED, GREEN, BLUE, YELLOW]
    write_square(folder, unlit_picture(), shapes.png(columns, rows, lambda x, y: (*colors[x + y], 255)), samplers=[{}])
    pixels, _ = render(folder)
    for k, color in enumerate(colors):
        middle = (k + 0.5) / 4
        assert at(pixels, *((0.5, middle) if columns == 1 else (middle, 0.5))) == pytest.approx(color, abs=40)


def test_a_transform_of_the_texture(folder):
    """A quarter turn and a shift by half the picture. A positive angle turns the coordinates counterclockwise in the
    picture: (u, v) becomes (v, -u)."""
    turned = {"extensions": {"KHR_texture_transform": {"rotation": 1.5707963267948966, "offset": [0, 1]}}}
    write_square(folder, unlit_picture(**turned), shapes.png(2, 2, four_colors))
    pixels, _ = render(folder)
    assert [at(pixels, x, y) for y in (0.25, 0.75) for x in (0.25, 0.75)] == [BLUE, RED, YELLOW, GREEN]


def test_colors_are_linear_values(folder):
    """The linear value 0.5 is the value 188 of sRGB."""
    write_square(folder, {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0, 1, 1]}, "extensions": UNLIT})
    pixels, _ = render(folder)
    assert at(pixels, 0.5, 0.5) == pytest.approx((188, 0, 255), abs=1)
    write_square(folder, {"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
                          "emissiveFactor": [0.5, 0, 1]})
    pixels, _ = render(folder)
    red, green, blue = at(pixels, 0.5, 0.5)
    assert 180 < red < 205 and green < 70 and blue > 240, "emission, and a weak reflection of the lights"


def test_vertex_colors_multiply_the_material(folder):
    write_square(folder, {"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 0, 1]}, "extensions": UNLIT},
                 colors=[[0.5, 1, 1, 1]] * 4)
    pixels, _ = render(folder)
    assert at(pixels, 0.5, 0.5) == pytest.approx((188, 255, 0), abs=1)


def test_a_lit_texture_and_metal(folder):
    """A red dull plastic and a red rough metal are red; a white one would be gray."""
    texture = {"baseColorTexture": {"index": 0}, "roughnessFactor": 1}
    red = shapes.png(1, 1, lambda x, y: (*RED, 255))
    write_square(folder, {"pbrMetallicRoughness": {**texture, "metallicFactor": 0}}, red)
    plastic = at(render(folder)[0], 0.5, 0.5)
    write_square(folder, {"pbrMetallicRoughness": {**texture, "metallicFactor": 1}}, red)
    metal = at(render(folder)[0], 0.5, 0.5)
    for red, green, blue in (plastic, metal):
        assert red > 100 and red > 2 * green and red > 2 * blue


def test_a_texture_of_metal_and_roughness(folder):
    """Green is the roughness, blue is the metallic part, and red has no meaning. The same values as factors give the same
    colors."""
    red = {"baseColorFactor": [0.8, 0.1, 0.1, 1]}
    picture = shapes.png(2, 1, lambda x, y: (13, 255, 0, 255) if x == 0 else (200, 102, 255, 255))
    write_square(folder, {"pbrMetallicRoughness": {**red, "metallicRoughnessTexture": {"index": 0}}}, picture)
    drawn, _ = render(folder)
    halves = []
    for x, metallic, roughness in ((0.25, 0, 1), (0.75, 1, 0.4)):
        write_square(folder, {"pbrMetallicRoughness": {**red, "metallicFactor": metallic, "roughnessFactor": roughness}})
        halves.append(at(render(folder)[0], x, 0.5))
        assert at(drawn, x, 0.5) == pytest.approx(halves[-1], abs=1)
    assert np.abs(np.subtract(*halves)).max() > 20


def test_a_normal_texture_changes_the_shading(folder):
    """Normals that point to the left and to the right get different light, because the main light is at one side."""
    lit = {"pbrMetallicRoughness": {"metallicFactor": 0}, "normalTexture": {"index": 0}}
    write_square(folder, lit, shapes.png(2, 1, lambda x, y: (40 if x == 0 else 216, 128, 215, 255)))
    pixels, _ = render(folder)
    assert abs(at(pixels, 0.25, 0.5)[0] - at(pixels, 0.75, 0.5)[0]) > 10


def test_transparent_parts_of_a_mask_are_not_drawn(folder):
    half = shapes.png(2, 1, lambda x, y: (*RED, 255 if x == 0 else 100))
    write_square(folder, {**unlit_picture(), "alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": True}, half)
    pixels, _ = render(folder)
    colors = {tuple(color) for row in pixels for color in row}
    assert RED in colors and colors - {RED, WHITE} <= {c for c in colors if c[0] == 255 and c[1] == c[2]}
    drawn = (pixels[80] == RED).all(axis=1).sum()
    assert drawn == pytest.approx(0.5 * (pixels[:, 100 - drawn // 2] == RED).all(axis=1).sum(), abs=2)


def test_opacity(folder):
    """An opaque material ignores the alpha of its picture. The opacity of a translucent one is the product of the factor
    and the alpha of the picture."""
    half = shapes.png(1, 1, lambda x, y: (*RED, 128))
    write_square(folder, unlit_picture(), half)
    assert at(render(folder)[0], 0.5, 0.5) == RED
    dark = {"baseColorTexture": {"index": 0}, "baseColorFactor": [0, 0, 0, 0.5], "metallicFactor": 0}
    emission = {"emissiveFactor": [0, 0, 0]}
    write_square(folder, {"pbrMetallicRoughness": dark, **emission, "alphaMode": "BLEND"}, half)
    quarter = at(render(folder)[0], 0.5, 0.5)
    write_square(folder, {"pbrMetallicRoughness": dark, **emission}, half)
    opaque = at(render(folder)[0], 0.5, 0.5)
    assert max(opaque) < 60, "black with a weak reflection"
    assert quarter == pytest.approx([0.75 * 255 + 0.25 * c for c in opaque], abs=6)


def test_edges_over_a_normal_texture(folder):
    lit = {"pbrMetallicRoughness": {"metallicFactor": 0}, "normalTexture": {"index": 0}}
    write_square(folder, lit, shapes.png(1, 1, lambda x, y: (128, 128, 255, 255)))
    without = render(folder)[0].astype(int)
    edges = render(folder, "square.gltf", "--edges")[0].astype(int)
    changed = (abs(without - edges).max(axis=2) > 20).sum()
    assert 100 < changed < 2000, "five lines, and the surface between them as before"


def test_a_texture_without_area_next_to_a_normal_texture(folder):
    """All texture coordinates are equal, so they have no direction."""
    lit = {"pbrMetallicRoughness": {"metallicFactor": 0}, "normalTexture": {"index": 0}}
    write_square(folder, lit, shapes.png(1, 1, lambda x, y: (128, 128, 255, 255)), coordinates=[[0.5, 0.5]] * 4)
    assert min(at(render(folder)[0], 0.5, 0.5)) > 100, "lit"


def test_a_gray_jpeg_is_gray_and_padding_is_ignored(folder):
    gray = base64.b64decode(GRAY_JPEG)
    write_square(folder, unlit_picture(), gray, kind="jpeg")
    red, green, blue = at(render(folder)[0], 0.5, 0.5)
    assert red == green == blue == pytest.approx(100, abs=2)
    write_square(folder, unlit_picture(), shapes.png(2, 2, four_colors))
    text = json.loads((folder / "square.gltf").read_text())
    data = shapes.png(2, 2, four_colors) + b"\0\0\0"
    text["buffers"].append({"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()})
    text["bufferViews"].append({"buffer": 1, "byteLength": len(data)})
    text["images"] = [{"bufferView": len(text["bufferViews"]) - 1, "mimeType": "image/png"}]
    folder.write("square.gltf", json.dumps(text))
    pixels, run = render(folder)
    assert run.err == "" and at(pixels, 0.25, 0.25) == RED


def test_colors_of_an_array_and_a_plain_surface(folder):
    write_square(folder, unlit_picture(), shapes.png(2, 2, four_colors))
    plain, _ = render(folder, "square.gltf", "--plain")
    red, green, blue = at(plain, 0.25, 0.25)
    assert max(red, green, blue) - min(red, green, blue) < 40, "gray"
    folder.run("weights", "square.gltf", "--handles", "auto:1", "--domain", "surface", "-o", "w.vtp").is_good()
    weights, _ = render(folder, "w.vtp", "--array", "Weights")
    assert at(weights, 0.25, 0.25) != RED


def test_the_look_of_another_file(folder):
    """A posed mesh in a .vtp file has no materials of its own."""
    write_square(folder, unlit_picture(), shapes.png(2, 2, four_colors))
    folder.run("weights", "square.gltf", "--handles", "auto:1", "--domain", "surface", "-o", "w.vtp").is_good()
    pixels, _ = render(folder, "w.vtp", "--look", "square.gltf")
    assert at(pixels, 0.25, 0.25) == RED
    folder.off("bar.off", shapes.bar())
    words = ("--size", "200x160", "-o", "q.png", "--look")
    folder.run("render", "bar.off", *words, "square.gltf").is_refused("points, but the mesh of square.gltf has 4; --look needs")
    folder.run("render", "bar.off", *words, "bar.off").is_refused("bar.off", "expected .glb, .gltf, .obj, .ply")
    folder.run("render", "w.vtp", *words, "square.gltf", "--plain").is_refused("--look cannot be combined with --plain")


def test_an_obj_file_with_pictures(folder):
    """The texture coordinates of OBJ have their origin at the lower left."""
    folder.write("s.obj", "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                          "usemtl m\nf 1/1 2/2 3/3 4/4\n")
    folder.write("s.mtl", "newmtl m\nKd 1 1 1\nNs 0\nmap_Kd s.png\n")
    folder.write("s.png", shapes.png(2, 2, four_colors))
    pixels, run = render(folder, "s.obj")
    assert run.err == ""
    centers = [at(pixels, x, y) for x, y in ((0.25, 0.25), (0.75, 0.25), (0.25, 0.75))]
    assert [color.index(max(color)) for color in centers] == [0, 1, 2]


def bmp(columns, rows, color):
    """Return a picture as the bytes of a BMP file, whose lines begin at the bottom."""
    lines = b"".join(b"".join(bytes(color(x, y)[2::-1]) for x in range(columns)).ljust((3 * columns + 3) // 4 * 4, b"\0")
                     for y in reversed(range(rows)))
    return (b"BM" + struct.pack("<IHHI", 54 + len(lines), 0, 0, 54)
            + struct.pack("<IiiHHIIiiII", 40, columns, rows, 1, 24, 0, len(lines), 2835, 2835, 0, 0) + lines)


def tga(columns, rows, color, from_top=False, in_runs=False):
    run = b"\0" if in_runs else b""  # one pixel that follows
    lines = [b"".join(run + bytes(color(x, y)[2::-1]) for x in range(columns)) for y in range(rows)]
    head = struct.pack("<BBBHHBHHHHBB", 0, 0, 10 if in_runs else 2, 0, 0, 0, 0, 0, columns, rows, 24, 0x20 if from_top else 0)
    return head + b"".join(lines if from_top else reversed(lines))


@pytest.mark.parametrize("name, picture", [
    ("s.bmp", bmp(2, 2, four_colors)), ("s.TGA", tga(2, 2, four_colors)), ("s.tga", tga(2, 2, four_colors, True)),
    ("runs.tga", tga(2, 2, four_colors, in_runs=True))])
def test_other_formats_of_pictures_become_png(folder, name, picture):
    folder.write("s.obj", "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                          "usemtl m\nf 1/1 2/2 3/3 4/4\n")
    folder.write("s.mtl", f"newmtl m\nKd 1 1 1\nNs 0\nmap_Kd {name}\n")
    folder.write(name, picture)
    pixels, run = render(folder, "s.obj")
    assert run.err == ""
    centers = [at(pixels, x, y) for x, y in ((0.25, 0.25), (0.75, 0.25), (0.25, 0.75))]
    assert [color.index(max(color)) for color in centers] == [0, 1, 2]
    folder.run("rig", "s.obj", "--handles", "auto:1", "--domain", "surface", "-o", "s.glb").is_good()
    file = GltfFile(folder / "s.glb")
    assert file.json["images"][0]["mimeType"] == "image/png"
    assert file.view(file.json["images"][0]["bufferView"])[1:4] == b"PNG"
    folder.write(name, picture[:-5])
    assert f"the picture '{name}' is left out because it is damaged" in render(folder, "s.obj")[1].err


# A square of 100 x 100 cm with an embedded picture. Polygons end with the bitwise complement of a vertex.
FBX = """; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}
Objects:  {
	Geometry: 1, "Geometry::square", "Mesh" {
		Vertices: *12 { a: 0,0,0,100,0,0,100,100,0,0,100,0 }
		PolygonVertexIndex: *4 { a: 0,1,2,-4 }
		LayerElementUV: 0 {
			Version: 101
			Name: "map"
			MappingInformationType: "ByVertice"
			ReferenceInformationType: "Direct"
			UV: *8 { a: 0,0,1,0,1,1,0,1 }
		}
		LayerElementMaterial: 0 {
			Version: 101
			Name: ""
			MappingInformationType: "AllSame"
			ReferenceInformationType: "IndexToDirect"
			Materials: *1 { a: 0 }
		}
		Layer: 0 {
			Version: 100
			LayerElement:  {
				Type: "LayerElementUV"
				TypedIndex: 0
			}
			LayerElement:  {
				Type: "LayerElementMaterial"
				TypedIndex: 0
			}
		}
	}
	Model: 2, "Model::square", "Mesh" {
		Version: 232
	}
	Material: 3, "Material::m", "" {
		Version: 102
		ShadingModel: "phong"
	}
	Texture: 4, "Texture::t", "" {
		Type: "TextureVideoClip"
		FileName: "C:\\\\pictures\\\\s.tga"
		RelativeFilename: "s.tga"
	}
	Video: 5, "Video::v", "Clip" {
		Type: "Clip"
		FileName: "C:\\\\pictures\\\\s.tga"
		RelativeFilename: "s.tga"
		Content: , "{content}"
	}
}
Connections:  {
	C: "OO",2,0
	C: "OO",1,2
	C: "OO",3,2
	C: "OP",4,3,"DiffuseColor"
	C: "OO",5,4
}
"""


@pytest.mark.parametrize("picture", [tga(2, 2, four_colors), bmp(2, 2, four_colors), shapes.png(2, 2, four_colors)],
                         ids=["tga", "bmp", "png"])
def test_pictures_in_fbx_files(folder, picture):
    folder.write("s.fbx", FBX.replace("{content}", base64.b64encode(picture).decode()))
    pixels, run = render(folder, "s.fbx")
    assert run.err == ""
    centers = [at(pixels, x, y) for x, y in ((0.25, 0.25), (0.75, 0.25), (0.25, 0.75))]
    assert [color.index(max(color)) for color in centers] == [0, 1, 2]
    folder.run("rig", "s.fbx", "--handles", "auto:1", "--domain", "surface", "-o", "s.glb").is_good()
    image, = GltfFile(folder / "s.glb").json["images"]
    assert image["mimeType"] == "image/png" and "uri" not in image


def test_half_of_an_fbx_file(folder):
    folder.write("s.fbx", FBX[:len(FBX) // 2])
    folder.run("rig", "s.fbx", "-o", "s.glb").is_refused("s.fbx")
    folder.run("render", "s.fbx", "-o", "s.png").is_refused("s.fbx")


def test_colors_of_a_ply_file(folder):
    folder.write("c.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                          "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
                          "property list uchar int vertex_indices\nend_header\n"
                          "0 0 0 200 0 0\n1 0 0 200 0 0\n1 1 0 200 0 0\n0 1 0 200 0 0\n4 0 1 2 3\n")
    red, green, blue = at(render(folder, "c.ply")[0], 0.5, 0.5)
    assert red > 100 and red > 2 * green and red > 2 * blue


def test_bad_pictures(folder):
    """Pictures that are damaged or missing are left out with a warning. Those outside of the folder are refused."""
    picture = shapes.png(2, 2, four_colors)
    write_square(folder, unlit_picture(), picture[:60])
    _, run = render(folder)
    assert "square.gltf: picture 0 cannot be read" in run.err
    write_square(folder, unlit_picture(), b"not a picture")
    _, run = render(folder)
    assert "the picture 0 is not drawn because it is not PNG, JPEG, BMP, TIFF or TGA" in run.err
    write_square(folder, unlit_picture(), picture, uri="gone.png")
    _, run = render(folder)
    assert "the picture 'gone.png' is not drawn because" in run.err
    folder.path.parent.joinpath("secret.png").write_bytes(picture)
    write_square(folder, unlit_picture(), picture, uri="../secret.png")
    pixels, run = render(folder)
    assert "'../secret.png' is not in the folder" in run.err
    assert at(pixels, 0.25, 0.25) != RED
    folder.run("render", "square.gltf", "--look", "square.gltf", "-o", "x.png").is_refused("'../secret.png' is not in the folder")


def test_a_png_header_with_a_huge_size(folder):
    write_square(folder, unlit_picture(), shapes.huge_png())
    folder.run("render", "square.gltf", "--look", "square.gltf", "-o", "x.png").is_refused("100000 x 100000 pixels")
