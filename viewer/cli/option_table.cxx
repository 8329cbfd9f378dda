// The words of the command line. To add an option, add a row here; the verb reads it by its key.
#include "cli/option_table.h"

namespace bindpose::cli
{

std::string Option::key() const
{
  const std::string names = this->name;
  const std::size_t dashes = names.rfind("--");
  return dashes == std::string::npos ? names : names.substr(dashes + 2);
}

const std::vector<Verb>& verbs()
{
  using Kind = OptionKind;
  static const Option surface{ "SURFACE", "", Kind::text, "", "",
    "surface: obj, off, ply, stl, vtp, vtk or mesh", true };
  static const Option handles{ "--handles", "HANDLES", Kind::text, "", "",
    "handles: .tgf, .vtp, auto[:N] for N (8) points spread over the surface, or skeleton[:N] for "
    "(at most N) bones along the curve skeleton of what it encloses",
    true };
  static const std::vector<Verb> table{
    { "info", "say what a file holds",
      { { "FILE", "", Kind::text, "", "", "any mesh, volume or handle file", true },
        { "--defects", "OUT", Kind::text, "", "",
          "also write where a surface is unclean, as cells with the array Defect (.vtp)" } } },
    { "winding",
      "winding number of a surface, a plane curve or oriented points, on a grid or at points",
      { surface,
        { "--grid", "N", Kind::integer, "64", "", "samples along the longest side, cubic voxels",
          false, false, 2 },
        { "--points", "DATASET", Kind::text, "", "",
          "evaluate at the points of this file instead of on a grid" },
        { "--cell-centers", "", Kind::flag, "", "", "with --points: at the cells' centers" },
        { "--method", "METHOD", Kind::choice, "auto", "auto|exact|fast",
          "exact is true to round-off, fast keeps within --tolerance; auto is exact where that is "
          "soon done (closed surfaces), else fast" },
        { "--tolerance", "NUMBER", Kind::number, "1e-3", "",
          "largest error of fast, from 1e-8 to 0.1" },
        { "--gradient", "", Kind::flag, "", "", "add the array WindingNumberGradient" },
        { "--inside", "", Kind::flag, "", "",
          "add the array Inside: 1 where the winding number is at least --winding-threshold" },
        { "--winding-threshold", "NUMBER", Kind::number, "0.5", "", "where inside begins" },
        { "--orient-patches", "", Kind::flag, "", "",
          "first turn triangles that look the other way than their neighbours, and closed parts "
          "that are inside out" },
        { "--float", "", Kind::flag, "", "", "write floats, not doubles" },
        { "--boundary", "FILE", Kind::text, "", "",
          "write the edges where the surface is open, too (.vtp)" },
        { "-o,--output", "OUT", Kind::text, "", "",
          ".vti or .vdb (OpenVDB) for a grid; the ending of DATASET's kind (.vtp, .vtu, .vti) for "
          "points",
          true },
        { "--vdb-band", "BAND", Kind::choice, "full", "full|narrow",
          "voxels that are active in a .vdb file: all but the background, or those near the "
          "surface only" },
        { "--vdb-band-width", "N", Kind::integer, "3", "",
          "voxels that a narrow band reaches to each side of the surface", false, false, 1 },
        { "--vdb-background", "NUMBER", Kind::number, "0", "",
          "value of a .vdb file outside of the grid" } } },
    { "tetrahedralize", "fill the inside of a surface with tets",
      { surface,
        { "--method", "METHOD", Kind::choice, "auto", "auto|cdt|remesh|embed|wrap|ftetwild",
          "cdt keeps the surface's vertices, remesh follows the winding number, embed merely holds "
          "the surface, wrap fills a closed surface around it (a thin shell where it is open), "
          "ftetwild runs fTetWild where it is installed; auto tries cdt, then remesh" },
        { "--winding-threshold", "NUMBER", Kind::number, "0.5", "",
          "inside is where the winding number is at least this" },
        { "--segmentation", "METHOD", Kind::choice, "graph-cut", "graph-cut|threshold",
          "of an open surface's tets by cdt: all together, or each by its winding number" },
        { "--cut-smoothness", "NUMBER", Kind::number, "1", "",
          "weight of a small boundary against the winding numbers" },
        { "--cut-sigma", "NUMBER", Kind::number, "0.1", "",
          "difference of winding numbers between tets that counts as surface" },
        { "--quality", "DEGREES", Kind::number, "0", "",
          "smallest dihedral angle that every tet must have, 0 to 20: auto leaves the surface's "
          "triangles for it where they do not allow it; remesh reaches 10.7 on any surface" },
        { "--bare", "", Kind::flag, "", "",
          "cdt and wrap: add no vertices inside and leave flat tets as they are" },
        { "--interior-edge", "FRACTION", Kind::number, "0", "",
          "longest edges that cdt and wrap leave inside, and those that ftetwild aims at, of the "
          "surface's diagonal; 0: automatic" },
        { "--keep-outside", "", Kind::flag, "", "",
          "with --method cdt: write all tets of the hull, to look at the array Label" },
        { "--handles", "HANDLES", Kind::text, "", "",
          "handles, .tgf or .vtp: cdt and wrap make their points points of the mesh, and put "
          "points along "
          "bones and cages" },
        { "--resolution", "CUBES", Kind::integer, "0", "",
          "lattice cubes along the longest side (remesh, embed), 4 to 1000; 0: 40 for remesh, "
          "about "
          "30,000 tets for embed",
          false, false, 0 },
        { "--wrap-alpha", "FRACTION", Kind::number, "0.02", "",
          "of wrap: radius of the ball that carves it, of the surface's diagonal; gaps below twice "
          "this are closed" },
        { "--wrap-offset", "FRACTION", Kind::number, "0.001", "",
          "of wrap: its distance from the surface, of the diagonal" },
        { "--ftetwild-epsilon", "FRACTION", Kind::number, "0.001", "",
          "of ftetwild: how far from the surface the tets may end, of the diagonal" },
        { "--time-limit", "SECONDS", Kind::number, "0", "",
          "for the meshing process; 0: 120, or 120 per million triangles if that is more" },
        { "--memory-limit", "MIB", Kind::integer, "0", "",
          "address space of the meshing process; 0: no limit", false, false, 0 },
        { "-o,--output", "OUT", Kind::text, "", "", ".vtu, .vtk or .mesh", true } } },
    { "outline", "what an image shows, or what curves in a plane enclose, as quality triangles",
      { { "IMAGE_OR_CURVES", "", Kind::text, "", "",
          "image: png, jpg, tif or bmp, cut out by its alpha; or curves in a plane z = const: "
          "lines "
          "or polygons of a .vtp, .vtk or .obj file",
          true },
        { "--rectangle", "", Kind::flag, "", "", "the whole image, whatever its alpha" },
        { "--simplify", "PIXELS", Kind::number, "0.5", "",
          "how far simplifying may move an image's outline, 0 to 1" },
        { "--winding-threshold", "NUMBER", Kind::number, "0.5", "",
          "inside is where the curves' winding number is at least this" },
        { "--min-angle", "DEGREES", Kind::number, "30", "",
          "smallest angle of a triangle, 0 to 33, where the outline itself has none smaller" },
        { "--edge", "FRACTION", Kind::number, "0.02", "",
          "longest edge of a triangle, as a fraction of the diagonal; 0: no bound" },
        { "--handles", "HANDLES", Kind::text, "", "",
          "handles, .tgf or .vtp: points become points of the mesh, bones rows of edges" },
        { "-o,--output", "OUT", Kind::text, "", "",
          ".vtp or .vtk: triangles with texture coordinates TCoords", true } } },
    { "handles", "handles without a hand: bones along the curve skeleton, or points",
      { { "MESH", "", Kind::text, "", "",
          "surface, however unclean, or tets as .vtu, .vtk or .mesh", true },
        { "--points", "N", Kind::integer, "", "",
          "N points spread over the shape, each the farthest from all before it, instead of bones; "
          "every component gets its share",
          false, false, 1 },
        { "--distance", "HOW", Kind::choice, "along-edges", "along-edges|straight",
          "of points: along the surface's edges, or through space" },
        { "--on-surface", "", Kind::flag, "", "",
          "of points: leave them on the surface, else they are moved into the middle of the "
          "shape" },
        { "--bones", "N", Kind::integer, "0", "", "bones at most; 0: any number", false, false, 0 },
        { "--bone-tolerance", "FRACTION", Kind::number, "0.03", "",
          "how far the curve skeleton may be from its bones, of the diagonal, 0.001 to 1" },
        { "--longest-bone", "FRACTION", Kind::number, "0", "",
          "split longer bones, of the diagonal, at least 0.01; 0: straight ones stay whole" },
        { "--prune", "NUMBER", Kind::number, "1", "",
          "branches shorter than this times half of the thickness where they begin are no limbs, 0 "
          "to 10" },
        { "--skeleton-triangles", "N", Kind::integer, "10000", "",
          "about as many even triangles are contracted to the curve skeleton, 100 to 1000000",
          false, false, 0 },
        { "--winding-threshold", "NUMBER", Kind::number, "0.5", "",
          "inside is where the winding number is at least this" },
        { "--time-limit", "SECONDS", Kind::number, "120", "", "for the helper process" },
        { "--memory-limit", "MIB", Kind::integer, "0", "",
          "address space of the helper process; 0: no limit", false, false, 0 },
        { "-o,--output", "OUT", Kind::text, "", "",
          ".vtp, .vtk or .tgf (which keeps no names of bones)", true } } },
    { "weights", "smooth weights, one function a handle",
      { { "MESH", "", Kind::text, "", "", "surface, or tets as .vtu, .vtk or .mesh", true },
        handles,
        { "--regions", "ARRAY", Kind::text, "", "",
          "point array of labels; each label above 0 is a region handle" },
        { "--method", "METHOD", Kind::choice, "bounded-biharmonic",
          "bounded-biharmonic|monotone|harmonic|biharmonic|triharmonic|graph-biharmonic|"
          "linear-subspace|inverse-distance|smoothed-harmonic|bone-heat",
          "which weights; all but the first two are to compare with" },
        { "--domain", "DOMAIN", Kind::choice, "auto", "auto|volume|embedding|cage|surface",
          "solve in tets of the inside, in a lattice that holds the surface, in the cage of the "
          "handles around it, or on the surface; "
          "auto: flat shapes on themselves, closed and clean ones in their volume where that is "
          "quick, all others, and where that fails, in the lattice" },
        { "--resolution", "CUBES", Kind::integer, "0", "",
          "embedding: lattice cubes along the longest side; 0: finer until two lattices agree" },
        { "--stage", "STAGE", Kind::choice, "certified", "certified|preview",
          "preview: something to look at in the time of a factorisation" },
        { "--endpoints", "HOW", Kind::choice, "none", "none|projection|joints|bounded",
          "also the array EndpointWeights, how far along each bone a point is (for deform --method "
          "stbs): projected to it, by bounded weights of all bones' ends, or bounded and linear "
          "along each bone" },
        { "--order", "ORDER", Kind::choice, "2", "2|3",
          "of bounded-biharmonic and monotone: 2 least bending, 3 (triharmonic) smoother still" },
        { "--certificate", "HOW", Kind::choice, "default", "default|tight",
          "what proves a column: relative gap and residual at most 1e-6, or 1e-9" },
        { "--iterations", "N", Kind::integer, "100", "",
          "at most for a handle; exit code 3 when they do not suffice" },
        { "--memory-limit", "MIB", Kind::integer, "0", "",
          "of the whole process; what would take more is refused before it is begun; 0: as much as "
          "is available",
          false, false, 0 },
        { "--rigidity", "ARRAY", Kind::text, "", "",
          "point array of painted rigidity, 0 and more: weights hardly vary where it is 1 or more; "
          "of bounded-biharmonic and monotone, as all down to --partition; default: Rigidity" },
        { "--rigid-sets", "ARRAY", Kind::text, "", "",
          "point array of labels: weights are constant on each above 0; default: RigidSet" },
        { "--pins", "ARRAY", Kind::text, "", "",
          "point array of given weights, a component a handle, NaN where free; default: "
          "PinnedWeights" },
        { "--bounds", "LEAST,LARGEST", Kind::text, "0,1", "",
          "of all weights; only a wider range than 0,1 can be kept. Of single handles: cell array "
          "WeightBounds of .vtp handles; of points: arrays WeightsLower and WeightsUpper, a "
          "component "
          "a handle" },
        { "--mirror", "AXIS", Kind::choice, "none", "none|x|y|z",
          "handles that are mirror images in the plane across the middle get mirrored weights; "
          "with none the point array SymmetricPoint says so" },
        { "--influences", "K", Kind::integer, "0", "",
          "handles with a weight at a point, at most: the largest, solved for again; 0: any "
          "number" },
        { "--partition", "HOW", Kind::choice, "normalise", "normalise|coupled",
          "divide rows by their sums, or solve for all columns together with the sums as "
          "constraints: of bounded-biharmonic, slow" },
        { "--raw", "", Kind::flag, "", "",
          "add RawWeights: the columns that the certificate is about, before rows are divided by "
          "their sums" },
        { "--keep-mesh", "", Kind::flag, "", "",
          "split no cell: the corners around a handle stand for it" },
        { "--gltf-influences", "N", Kind::integer, "0", "",
          "of .glb and .gltf: weights of a vertex that are written, the largest; 0: all" },
        { "-o,--output", "OUT", Kind::text, "", "",
          ".vtp or .dmat: weights at the surface's own points; .vtu: tets with weights; .glb or "
          ".gltf: a rig for Blender and game engines",
          true } } },
    { "smooth", "smooth data on a mesh and leave the extrema that are asked for, no other",
      { { "MESH", "", Kind::text, "", "", "surface or tets with the data: .vtp, .vtu or .vtk",
          true },
        { "--array", "NAME", Kind::text, "", "",
          "point array of the data, one number a point; default: the active scalars" },
        { "--extrema", "ARRAY", Kind::text, "", "",
          "point array that lists the extrema: above 0 a maximum, below 0 a minimum, 0 neither; "
          "default: Extrema where the mesh has it and neither of the next two is given" },
        { "--persistence", "SHARE", Kind::number, "", "",
          "extrema of the data that are more persistent than this share of its range stay, 0 to "
          "below 1; default: 0.05" },
        { "--count", "N", Kind::integer, "0", "",
          "so many of the most persistent extrema stay, at least a maximum and a minimum of each "
          "connected part; 0: by --persistence" },
        { "--data-weight", "NUMBER", Kind::number, "1e6", "",
          "how faithful to be: detail finer than about six times NUMBER^(-1 / 2 ORDER) of the "
          "mesh's size goes; 0: only the values at the extrema count" },
        { "--keep-values", "", Kind::flag, "", "", "extrema keep the data's values" },
        { "--order", "ORDER", Kind::choice, "2", "2|3",
          "of the energy: 2 least bending, 3 (triharmonic) smoother still" },
        { "--guide", "GUIDE", Kind::choice, "unconstrained", "unconstrained|harmonic",
          "which way the result rises: as the smooth function without any order does, freed from "
          "other extrema, or as the harmonic function between the extrema does" },
        { "--rebuilds", "N", Kind::integer, "1", "",
          "how often that is taken anew from the result and solved for again" },
        { "--epsilon", "SHARE", Kind::number, "0", "",
          "of the data's range that each point is at least above a lower and below a higher "
          "neighbour" },
        { "--certificate", "HOW", Kind::choice, "default", "default|tight",
          "what proves the result: relative gap and residual at most 1e-6, or 1e-9" },
        { "--iterations", "N", Kind::integer, "100", "",
          "at most for a solve; exit code 3 when they do not suffice" },
        { "--memory-limit", "MIB", Kind::integer, "0", "",
          "of the whole process; what would take more is refused before it is begun; 0: as much as "
          "is available",
          false, false, 0 },
        { "--extrema-output", "FILE", Kind::text, "", "",
          "also write the extrema as points with values and persistence (.vtp)" },
        { "-o,--output", "OUT", Kind::text, "", "",
          ".vtp, .vtu or .vtk: the mesh with the array Smoothed", true } } },
    { "deform", "bend a mesh with weights to a pose or a sequence of poses",
      { { "MESH_WITH_WEIGHTS", "", Kind::text, "", "",
          "what the verb weights wrote; for full-arap, mls and variational any mesh", true },
        { "--handles", "HANDLES", Kind::text, "", "",
          "handles: .tgf, .vtp, .glb or .gltf; all but --fair need them", true, false, 0, "fair" },
        { "--pose", "POSE", Kind::text, "", "",
          "pose or sequence as .json, where numbers may be expressions in t, the time in seconds; "
          "or a pose of libigl in a .dmat file, or the animation in a .glb or .gltf file; all but "
          "--fair need it",
          true, false, 0, "fair" },
        { "--method", "METHOD", Kind::choice, "lbs",
          "lbs|dqs|stbs|cor|reduced-arap|full-arap|mls|variational",
          "linear blend, dual quaternions, stretchable and twistable bones (along the point array "
          "EndpointWeights), centres of rotation, reduced as-rigid-as-possible; without weights: "
          "full as-rigid-as-possible, moving least squares, which knows nothing of the shape, or "
          "the fair surface between what handles and the point array Fixed hold" },
        { "--single-precision", "", Kind::flag, "", "",
          "of lbs, dqs, stbs and cor: weights and transforms as floats: half the memory, up to "
          "twice "
          "as fast, right to about a millionth of the diagonal" },
        { "--influences", "N", Kind::integer, "0", "",
          "of lbs, dqs, stbs and cor: weights of a vertex that count, the largest; 0: all; the "
          "report "
          "tells what is lost (dropped_share)" },
        { "--smallest-weight", "NUMBER", Kind::number, "0", "",
          "of lbs, dqs, stbs and cor: weights of at most this size do not count" },
        { "--pseudo-edges", "WHICH", Kind::choice, "given", "none|given|auto",
          "of lbs, dqs, stbs and cor: edges between points that tell how these turn when they are "
          "dragged: those of the handles, or the tree that joins near points through the shape" },
        { "--pseudo-edge-stretch", "", Kind::flag, "", "",
          "scale points by how much longer their pseudo-edges become" },
        { "--energy", "ENERGY", Kind::choice, "auto",
          "auto|spokes-and-rims|spokes|tetrahedra|triangles",
          "of reduced-arap and full-arap: which edges share a rotation; auto: tetrahedra on tets, "
          "spokes-and-rims on surfaces" },
        { "--iterations", "N", Kind::integer, "0", "",
          "of reduced-arap and full-arap: at most; 0: 100 and 500" },
        { "--tolerance", "NUMBER", Kind::number, "1e-6", "",
          "of reduced-arap and full-arap: an iteration that lowers the energy by less than this "
          "share of it is the last" },
        { "--budget-us", "MICROSECONDS", Kind::number, "0", "",
          "of reduced-arap: time for the iterations of a pose; 0: no limit; how many that allowed "
          "is reported, and --iterations with it and --tolerance 0 repeats the result" },
        { "--extra-weights", "N", Kind::integer, "0", "",
          "of reduced-arap: weights beside the handles', which let the mesh bend where no handle "
          "is; 15 is a good number",
          false, false, 0 },
        { "--extra-kind", "KIND", Kind::choice, "bumps", "bumps|eigenmodes",
          "of --extra-weights: bumps around places far apart, or the smoothest weights that vanish "
          "at the handles (skinning eigenmodes)" },
        { "--dynamics", "", Kind::flag, "", "",
          "the mesh as a body with mass, by reduced-arap's energy, whatever --method is: what "
          "handles leave open swings and falls; a handle that becomes free lets go" },
        { "--frames", "N", Kind::integer, "0", "",
          "of poses with expressions in t, and of --dynamics: steps in time, the first at t = 0; "
          "0: as many as the pose file has frames",
          false, false, 0 },
        { "--time-step", "SECONDS", Kind::number, "0.0416666666666667", "", "between them" },
        { "--gravity", "X,Y,Z", Kind::text, "0,0,0", "", "of --dynamics: lengths / s^2" },
        { "--damping", "NUMBER", Kind::number, "0", "",
          "of --dynamics: drag, this times mass times velocity, 1 / s" },
        { "--stiffness", "NUMBER", Kind::number, "1000", "",
          "of --dynamics: energy per volume (of surfaces per area) of a strain of one" },
        { "--density", "NUMBER", Kind::number, "1", "",
          "of --dynamics: mass per volume (of surfaces per area)" },
        { "--exponent", "NUMBER", Kind::number, "1", "",
          "of mls: handles count by 1 / distance^(2 NUMBER), 1 to 8" },
        { "--order", "ORDER", Kind::choice, "2", "1|2|3",
          "of variational: 1 a membrane, 2 a thin plate, 3 smoother still; the operator is that of "
          "the mesh at rest or of its point array Parameterization" },
        { "--boundary", "BOUNDARY", Kind::choice, "region", "region|curve|tangent",
          "of variational: what is fixed is a band that the surface continues smoothly, or its "
          "edge alone, or the edge with --tangents" },
        { "--tangents", "SOURCE", Kind::choice, "surroundings", "surroundings|given|clamped",
          "of --boundary tangent: as beyond the edge, of the point array Tangents, or as at rest" },
        { "--fair", "", Kind::flag, "", "",
          "of variational: the free points are made anew from what is around them, for holes and "
          "blends; else they are moved; the point array Fixed may hold the rest without handles" },
        { "--gltf-animation", "HOW", Kind::choice, "auto", "auto|joints|morph",
          "of .glb and .gltf: frames move joints, which is what linear blends do, or each is a "
          "morph target; auto: joints for lbs, morph for all others" },
        { "--gltf-influences", "N", Kind::integer, "0", "",
          "of .glb and .gltf: weights of a vertex that are written, the largest; 0: all" },
        { "--stretch-limit", "NUMBER", Kind::number, "2", "",
          "the report counts elements that become more than this many times as long in some "
          "direction, or less than one over this, and those turned inside out; 0: it does not" },
        { "--stretch-array", "", Kind::flag, "", "",
          "write the cell array Stretch: the largest and the smallest stretch of each cell, the "
          "smallest below 0 where it is inside out" },
        { "--rotation-arrays", "", Kind::flag, "", "",
          "of reduced-arap, full-arap and --dynamics: write the point arrays RotationCluster, the "
          "number of the rotation that a vertex follows, and Rotation, its axis times its angle in "
          "degrees" },
        { "-o,--output", "OUT", Kind::text, "", "",
          "mesh file; a sequence gives OUT_0000, OUT_0001, … and OUT.pvd; .glb or .gltf: the rest "
          "mesh with its joints, posed or animated, in one file",
          true } } },
    { "render", "picture of one or more datasets",
      { { "FILE", "", Kind::text, "", "",
          "surfaces, tets, volumes; one tile each; or a sequence (.pvd), a tile a frame", true,
          true },
        { "-o,--output", "OUT", Kind::text, "", "",
          ".png; .gif, .webm, .mp4 or .apng (by ffmpeg): the files one after another, from one "
          "place",
          true },
        { "--frames", "N", Kind::integer, "0", "",
          "of a sequence: so many, evenly taken; 0: 12 in a .png, else all" },
        { "--fps", "NUMBER", Kind::number, "", "",
          "frames a second of moving pictures; else those of the sequence, or 24" },
        { "--array", "NAME", Kind::text, "", "", "colour by this array" },
        { "--color", "WHAT", Kind::choice, "array",
          "array|winding-number|label|quality|rung|handle|row-sum|rotation-cluster|rotation",
          "colour by --array, or tets by their winding number, by what the segmentation decided, "
          "by their smallest dihedral angle, or by the method that made them; meshes with weights "
          "by the handle with the greatest weight, or by the sums of RawWeights (weights --raw); "
          "posed ones by which rotation they follow, or by its angle (deform --rotation-arrays)" },
        { "--component", "NAME", Kind::text, "", "", "component of the array, by name or number" },
        { "--minus", "FILE", Kind::text, "", "",
          "show the array minus that of this file, which has as many points; without --array: "
          "Weights" },
        { "--extrema", "", Kind::flag, "", "",
          "balls at the local maxima and minima of the array away from handles; of those in tets, "
          "the ones on the drawn sides; without --array: of Weights" },
        { "--handles", "HANDLES", Kind::text, "", "", "draw these handles, too" },
        { "--handle-names", "", Kind::flag, "", "", "write the name beside each handle" },
        { "--range", "LOWER,UPPER", Kind::text, "", "",
          "values at the ends of the colours; else from the data, 0,1 for weights" },
        { "--columns", "N", Kind::integer, "0", "", "tiles in a row; 0: as square as possible" },
        { "--labels", "TEXT,…", Kind::text, "", "",
          "written below the tiles, in their order, with commas between" },
        { "--size", "WxH", Kind::text, "1200x900", "", "pixels of the whole picture" },
        { "--scale", "FACTOR", Kind::integer, "1", "",
          "1 to 8: the same picture in so many times as many pixels each way; lines, points, text "
          "and legends grow along" },
        { "--transparent", "", Kind::flag, "", "",
          "transparent background, in a .png: nothing where nothing is drawn" },
        { "--up", "AXIS", Kind::choice, "auto", "auto|x|y|z", "axis that points up; auto is y" },
        { "--azimuth", "DEGREES", Kind::number, "0", "", "look from farther to the right" },
        { "--elevation", "DEGREES", Kind::number, "0", "", "look from higher up" },
        { "--zoom", "FACTOR", Kind::number, "1", "", "larger in the picture" },
        { "--section", "PLANE", Kind::text, "0.5", "",
          "where tets are cut and volumes are sliced: from 0 (back) to 1 (front), x=0.2, or "
          "NX,NY,NZ@X,Y,Z for a normal and a point; none: tets whole" },
        { "--slice", "", Kind::flag, "", "",
          "cut tets through by the section's plane, instead of keeping whole ones: weights inside, "
          "with isolines" },
        { "--shrink", "SIZE", Kind::number, "1", "",
          "draw each tet this large, of its own size, above 0 to 1, apart from the others" },
        { "--defects", "", Kind::flag, "", "",
          "show where surfaces are unclean, those of --context, too, with names and counts" },
        { "--isosurface", "LEVEL,…", Kind::text, "", "",
          "show volumes by the surfaces where the value is this, instead of by a slice" },
        { "--volume", "", Kind::flag, "", "",
          "show winding numbers as a cloud that is clear where they are 0, instead of by a slice" },
        { "--context", "FILE", Kind::text, "", "",
          "draw these in every tile, too: surfaces see-through, boundary curves as tubes", false,
          true },
        { "--edges", "", Kind::flag, "", "", "draw the edges of surface triangles" },
        { "--title", "TEXT", Kind::text, "", "", "above the picture" } } },
    { "view", "window to look at datasets and volumes and to drag handles",
      { { "FILE", "", Kind::text, "", "",
          "meshes, handles, weights, pictures, volumes, curves, sessions", false, true },
        { "--auto-rig", "", Kind::flag, "", "",
          "make bones along the mesh, or points where it has none, and bind it, ready to drag" },
        { "--play", "TOUR", Kind::text, "", "",
          "do the steps of this tour (.json) in place of a person, check what it says, and end; "
          "the "
          "window may be on a display that nobody looks at" },
        { "--screenshot-dir", "FOLDER", Kind::text, "", "",
          "of --play: write the tour's pictures and tour.json, the numbers at each, here; without "
          "it "
          "the tour only checks" },
        { "--time-limit", "SECONDS", Kind::number, "0", "",
          "of --play: it may take so long; 0: what the tour says" } } },
  };
  return table;
}

const std::vector<Option>& common_options()
{
  using Kind = OptionKind;
  static const std::vector<Option> table{
    { "--report", "FILE", Kind::text, "", "",
      "write the numbers as JSON; - for the standard output" },
    { "--threads", "N", Kind::integer, "0", "",
      "threads to use, 0 for all cores; results do not depend on it" },
    { "--quiet", "", Kind::flag, "", "", "no progress, no warnings" },
    { "--overwrite", "", Kind::flag, "", "", "replace existing files" },
  };
  return table;
}

namespace
{
std::string row(const Option& option)
{
  std::string text = "| `";
  const std::string names = option.name;
  const std::size_t comma = names.find(',');
  text += comma == std::string::npos ? names : names.substr(0, comma);
  if (option.repeated)
  {
    text += "…";
  }
  text += option.value[0] ? std::string(" ") + option.value + "`" : "`";
  text += " | ";
  if (option.kind == OptionKind::choice)
  {
    std::string choices = option.choices;
    for (std::size_t at = choices.find('|'); at != std::string::npos; at = choices.find('|', at))
    {
      choices.replace(at, 1, ", ");
    }
    text += choices;
  }
  text += " | ";
  text += option.required && !option.unless[0] ? "required" : option.fallback;
  return text + " | " + option.help + " |\n";
}

const char* const table_head = "| option | choices | default | meaning |\n|---|---|---|---|\n";
} // namespace

std::string option_table_markdown()
{
  std::string text;
  for (const Verb& verb : verbs())
  {
    text += std::string("### `bindpose ") + verb.name + "`: " + verb.summary + "\n\n" + table_head;
    for (const Option& option : verb.options)
    {
      text += row(option);
    }
    text += '\n';
  }
  text += std::string("### Every verb\n\n") + table_head;
  for (const Option& option : common_options())
  {
    text += row(option);
  }
  return text;
}

} // namespace bindpose::cli
