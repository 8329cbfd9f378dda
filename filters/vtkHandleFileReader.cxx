// Reads handles from files. This file converts .tgf graphs: nodes without a bone become the first
// handles, and bones the next ones. The parents of bones follow from shared nodes.
// vtkMeshFileReader reads .vtp files; this file adds their missing arrays. gltf_data.h converts the
// joints of a glTF file.
#include "vtkHandleFileReader.h"

#include "base/execution.h"
#include "conversion.h"
#include "file_kind.h"
#include "gltf_data.h"
#include "io/tgf.h"
#include "pseudo_edge_cells.h"
#include "report_field_data.h"
#include "vtkMeshFileReader.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkHandleFileReader);

namespace
{
using bindpose::Handle;
using bindpose::HandleKind;
using bindpose::Handles;
using bindpose::Index;
using bindpose::Status;

/// Convert a graph to handles.
/// @param pseudo_edges  the pseudo-edges between nodes that are points
Handles to_handles(const bindpose::Tgf& graph, bindpose::PseudoEdges& pseudo_edges)
{
  std::vector<char> in_bone(graph.nodes.size(), 0);
  std::vector<char> in_cage(graph.nodes.size(), 0);
  for (const auto& edge : graph.edges)
  {
    if (edge.bone)
    {
      in_bone[edge.from] = in_bone[edge.to] = 1;
    }
    else if (edge.cage)
    {
      in_cage[edge.from] = in_cage[edge.to] = 1;
    }
  }
  std::vector<Index> handle_of_node(graph.nodes.size(), -1);
  Handles handles;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
  {
    if (in_bone[i] && !in_cage[i])
    {
      continue;
    }
    Handle point;
    point.head = point.tail = graph.nodes[i].position;
    point.kind = in_cage[i] ? HandleKind::cage_vertex : HandleKind::point;
    handle_of_node[i] = static_cast<Index>(handles.size());
    point.name = graph.nodes[i].text;
    if (point.name.empty())
    {
      point.name = "p" + std::to_string(handles.size() + 1);
    }
    handles.push_back(point);
  }
  for (const auto& edge : graph.edges)
  {
    if (!edge.bone && edge.cage)
    {
      const Index from = handle_of_node[edge.from];
      handles[from].cage.push_back({ from, handle_of_node[edge.to], -1 });
    }
  }
  for (const auto& edge : graph.edges)
  {
    const bindpose::PseudoEdge ends{ handle_of_node[edge.from], handle_of_node[edge.to] };
    if (edge.pseudo && !edge.bone && check_pseudo_edges(handles, { ends }).ok())
    {
      pseudo_edges.push_back(ends);
    }
  }
  const std::size_t points = handles.size();
  std::vector<const bindpose::Tgf::Edge*> bones;
  for (const auto& edge : graph.edges)
  {
    if (edge.bone)
    {
      bones.push_back(&edge);
    }
  }
  for (const auto* edge : bones)
  {
    Handle bone;
    bone.kind = HandleKind::bone;
    bone.name = "b" + std::to_string(handles.size() - points + 1);
    bone.head = graph.nodes[edge->from].position;
    bone.tail = graph.nodes[edge->to].position;
    for (std::size_t other = 0; other < bones.size() && bone.parent < 0; ++other)
    {
      if (bones[other] != edge && bones[other]->to == edge->from)
      {
        bone.parent = static_cast<Index>(points + other);
      }
    }
    handles.push_back(bone);
  }
  return handles;
}

Status read_tgf(const std::string& path, vtkPolyData* output)
{
  bindpose::Tgf graph;
  Status status = bindpose::read_tgf(path, graph);
  if (!status.ok())
  {
    return status;
  }
  bindpose::PseudoEdges pseudo_edges;
  const Handles handles = to_handles(graph, pseudo_edges);
  status = check_handles(handles);
  if (!status.ok())
  {
    status.message = path + ": " + status.message;
    return status;
  }
  output->ShallowCopy(bindpose::to_polydata(handles));
  if (!pseudo_edges.empty())
  {
    Handles list;
    std::vector<Index> cells;
    bindpose::to_handles(output, list, &cells);
    bindpose::add_pseudo_edges(output, cells, pseudo_edges);
  }
  Index unused_edges = -static_cast<Index>(pseudo_edges.size());
  for (const auto& edge : graph.edges)
  {
    unused_edges += !edge.bone && !edge.cage;
  }
  if (unused_edges > 0)
  {
    status.warnings.push_back(path + ": " + std::to_string(unused_edges) +
      " edges are ignored because they are neither bones nor cage edges nor pseudo-edges between "
      "points");
  }
  return status;
}

Status read_vtp(const std::string& path, vtkPolyData* output)
{
  vtkNew<vtkMeshFileReader> reader;
  // Silence the reader, because this filter's status repeats its message.
  vtkNew<vtkCallbackCommand> silent;
  reader->AddObserver(vtkCommand::ErrorEvent, silent);
  reader->SetFileName(path.c_str());
  reader->Update();
  Status status = bindpose::upstream_failure(reader->GetOutput());
  if (!status.ok())
  {
    return status;
  }
  auto* data = vtkPolyData::SafeDownCast(reader->GetOutput());
  Handles handles;
  std::vector<Index> cells;
  bindpose::Pose pose;
  status = bindpose::to_handles(data, handles, &cells);
  if (status.ok())
  {
    status = bindpose::to_pose(data, handles, cells, pose);
  }
  if (!status.ok())
  {
    status.message = path + ": " + status.message;
    return status;
  }
  output->ShallowCopy(data);
  if (static_cast<Index>(handles.size()) == data->GetNumberOfCells())
  {
    // Every cell is a handle, so cell i is the same handle in the complete dataset and in the file.
    auto complete = bindpose::to_polydata(handles);
    for (int i = 0; i < complete->GetCellData()->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = complete->GetCellData()->GetAbstractArray(i);
      if (!output->GetCellData()->GetAbstractArray(array->GetName()))
      {
        output->GetCellData()->AddArray(array);
      }
    }
  }
  bindpose::set_pose(output, cells, pose);
  return status;
}

Status read_gltf_handles(const std::string& path, vtkPolyData* output)
{
  bindpose::GltfData gltf;
  Status status = bindpose::read_gltf(path, gltf);
  status.warnings.clear(); // omit these warnings, because they are about the mesh
  status.report = {};
  if (status.ok() && gltf.handle_list.empty())
  {
    return Status::invalid_input(path + " has no skin and therefore no handles");
  }
  if (status.ok())
  {
    output->ShallowCopy(gltf.handles);
  }
  return status;
}
} // namespace

vtkHandleFileReader::vtkHandleFileReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkHandleFileReader::~vtkHandleFileReader()
{
  this->SetFileName(nullptr);
}

int vtkHandleFileReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

bindpose::Status vtkHandleFileReader::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector**, vtkInformationVector* output)
{
  bindpose::Phase phase(context, "read");
  const std::string path = this->FileName ? this->FileName : "";
  auto* data = vtkPolyData::GetData(output);
  Status status = bindpose::check_extension(path, GetFileExtensions());
  if (status.ok())
  {
    const std::string format = bindpose::file_extension(path);
    status = format == "tgf" ? read_tgf(path, data)
      : format == "vtp"      ? read_vtp(path, data)
                             : read_gltf_handles(path, data);
  }
  if (!status.ok())
  {
    return status;
  }
  Handles handles;
  bindpose::to_handles(data, handles);
  std::vector<std::string> names;
  std::vector<std::string> kinds;
  for (const Handle& handle : handles)
  {
    names.push_back(handle.name);
    kinds.emplace_back(to_string(handle.kind));
  }
  status.report.set("counts.handles", static_cast<int>(handles.size()));
  status.report.set("handles[].name", names);
  status.report.set("handles[].kind", kinds);
  return status;
}

void vtkHandleFileReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
