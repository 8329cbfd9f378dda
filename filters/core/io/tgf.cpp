// Parser and formatter of TGF texts (see tgf.h): nodes, a line with a single #, edges. Ids are
// arbitrary integers; edges refer to nodes by id.
#include "io/tgf.h"

#include "base/text_check.h"
#include "io/text_scanner.h"

#include <cmath>
#include <map>

namespace bindpose
{

namespace
{
using Ids = std::map<Index, Index>;

Status read_node(TextScanner& scanner, std::string_view first, Ids& ids, Tgf& graph)
{
  Index id = 0;
  if (!parse_index(first, id))
  {
    return scanner.error("the line of a node must begin with its id, an integer");
  }
  if (!ids.insert({ id, static_cast<Index>(graph.nodes.size()) }).second)
  {
    return scanner.error("node " + std::to_string(id) + " is defined twice");
  }
  Tgf::Node node;
  node.line = scanner.line();
  for (int k = 0; k < 3; ++k)
  {
    std::string_view word;
    double value = 0.0;
    if (!scanner.next_word(word) || !parse_number(word, value))
    {
      return scanner.error(
        "node " + std::to_string(id) + " must have three numbers as coordinates");
    }
    if (!std::isfinite(value))
    {
      return scanner.error(
        "node " + std::to_string(id) + " has a coordinate that is not a finite number");
    }
    node.position[k] = value;
  }
  node.text = std::string(scanner.rest_of_line());
  const std::string error = find_text_error(node.text);
  if (!error.empty())
  {
    return scanner.error("the name of node " + std::to_string(id) + " contains " + error +
      "; names must be UTF-8 without control characters");
  }
  graph.nodes.push_back(node);
  return {};
}

Status read_edge(TextScanner& scanner, std::string_view first, const Ids& ids, Tgf& graph)
{
  Tgf::Edge edge;
  edge.line = scanner.line();
  std::string_view words[2] = { first, {} };
  Index* ends[2] = { &edge.from, &edge.to };
  scanner.next_word(words[1]);
  for (int k = 0; k < 2; ++k)
  {
    Index id = 0;
    if (!parse_index(words[k], id))
    {
      return scanner.error("the line of an edge must begin with the ids of two nodes");
    }
    const auto node = ids.find(id);
    if (node == ids.end())
    {
      return scanner.error(
        "an edge references node " + std::to_string(id) + ", which does not exist");
    }
    *ends[k] = node->second;
  }
  if (edge.from == edge.to)
  {
    return scanner.error("an edge must connect two different nodes");
  }
  bool* flags[3] = { &edge.bone, &edge.pseudo, &edge.cage };
  for (bool* flag : flags)
  {
    std::string_view word;
    if (!scanner.next_word(word))
    {
      break;
    }
    if (word != "0" && word != "1")
    {
      return scanner.error("the flags is_bone, is_pseudo and is_cage of an edge must be 0 or 1");
    }
    *flag = word == "1";
  }
  graph.edges.push_back(edge);
  return {};
}

Status parse_graph(TextScanner scanner, Tgf& graph)
{
  Status status;
  graph = Tgf();
  Ids ids;
  bool in_edges = false;
  while (status.ok() && scanner.next_line())
  {
    std::string_view word;
    scanner.next_word(word);
    if (word[0] == '#')
    {
      if (in_edges)
      {
        break; // ignore the lines after a second #, as libigl does
      }
      in_edges = true;
      continue;
    }
    status = in_edges ? read_edge(scanner, word, ids, graph) : read_node(scanner, word, ids, graph);
  }
  if (status.ok() && graph.nodes.empty())
  {
    const char* const sentence = "there are no nodes";
    status = scanner.line() > 0 ? scanner.error(sentence) : Status::invalid_input(sentence);
  }
  if (!status.ok())
  {
    graph = Tgf();
  }
  return status;
}

/// Return a scanner without a comment character, because # separates nodes and edges.
TextScanner tgf_scanner(const std::string& path, std::string_view text)
{
  return { path, text, 0 };
}
} // namespace

Status parse_tgf(std::string_view text, Tgf& graph)
{
  return parse_graph(tgf_scanner({}, text), graph);
}

std::string format_tgf(const Tgf& graph)
{
  std::string text;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
  {
    append_index(text, static_cast<Index>(i) + 1);
    for (int k = 0; k < 3; ++k)
    {
      text += ' ';
      append_number(text, graph.nodes[i].position[k]);
    }
    text += (graph.nodes[i].text.empty() ? "" : " ") + graph.nodes[i].text + '\n';
  }
  text += "#\n";
  for (const Tgf::Edge& edge : graph.edges)
  {
    append_index(text, edge.from + 1);
    text += ' ';
    append_index(text, edge.to + 1);
    text += edge.bone ? " 1" : " 0";
    text += edge.pseudo ? " 1" : " 0";
    text += edge.cage ? " 1\n" : " 0\n";
  }
  return text;
}

Status read_tgf(const std::string& path, Tgf& graph)
{
  graph = Tgf();
  std::string text;
  const Status status = read_file(path, text);
  return status.ok() ? parse_graph(tgf_scanner(path, text), graph) : status;
}

Status write_tgf(const std::string& path, const Tgf& graph)
{
  return write_file(path, format_tgf(graph));
}

} // namespace bindpose
