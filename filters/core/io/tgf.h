#ifndef bindpose_io_tgf_h
#define bindpose_io_tgf_h

#include "geometry/mesh.h"

#include <string>
#include <string_view>

namespace bindpose
{

/// The content of a TGF text, a skeleton: nodes in space and edges between them.
struct Tgf
{
  struct Node
  {
    Vec3 position = Vec3::Zero();
    std::string text; ///< text after the coordinates; may be empty
    Index line = 0; ///< line in the text, for error messages
  };
  struct Edge
  {
    Index from = 0, to = 0; ///< indices into nodes: head and tail of a bone
    bool bone = true;
    bool pseudo = false;
    bool cage = false;
    Index line = 0;
  };
  std::vector<Node> nodes; ///< the nodes in the order of the text
  std::vector<Edge> edges; ///< the edges in the order of the text
};

/// Parse Jacobson's Trivial Graph Format: lines "id x y z [text]", a line "#", lines "from to
/// [is_bone is_pseudo is_cage]". An edge without flags is a bone.
/// @return invalid_input, naming the line, if there is no node, a word is not a number, a
/// coordinate is not finite, an id occurs twice, or an edge refers to an unknown node or connects a
/// node with itself. The graph is then empty.
Status parse_tgf(std::string_view text, Tgf& graph);

/// Return a skeleton as a text that parse_tgf() reads. Nodes have the ids 1, 2, …
std::string format_tgf(const Tgf& graph);

/// Read a file by parse_tgf(). Messages also name the file.
Status read_tgf(const std::string& path, Tgf& graph);

/// Write the text of format_tgf() to a file.
Status write_tgf(const std::string& path, const Tgf& graph);

} // namespace bindpose

#endif
