#ifndef bindpose_io_tgf_h
#define bindpose_io_tgf_h

#include "base/mesh.h"

#include <string>

namespace bindpose
{

/// A skeleton as stored in a TGF file: nodes in space and edges between them.
struct Tgf
{
  struct Node
  {
    Vec3 position = Vec3::Zero();
    std::string text; ///< text after the coordinates; may be empty
    Index line = 0; ///< line in the file, for error messages
  };
  struct Edge
  {
    Index from = 0, to = 0; ///< indices into nodes: head and tail of a bone
    bool bone = true;
    bool pseudo = false;
    bool cage = false;
    Index line = 0;
  };
  std::vector<Node> nodes; ///< in file order
  std::vector<Edge> edges; ///< in file order
};

/// Read Jacobson's Trivial Graph Format: lines "id x y z [text]", a line "#", lines "from to
/// [is_bone is_pseudo is_cage]" (an edge without flags is a bone).
/// invalid_input, with file and line, for: no node, words that are not numbers, coordinates that
/// are not finite, a duplicate id, an edge to an unknown node or to its own node.
Status read_tgf(const std::string& path, Tgf& graph);

Status write_tgf(const std::string& path, const Tgf& graph);

} // namespace bindpose

#endif
