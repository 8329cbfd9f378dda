#ifndef bindpose_weights_domain_choice_h
#define bindpose_weights_domain_choice_h

#include "surface/surface_repair.h"

#include <string>

namespace bindpose
{

/// Predicts from the surface alone whether weights in conforming tets of its inside will be well
/// conditioned and cheap, before any tet is made.
/// @return the reason why they will not, for the report; empty if they will: the surface is closed,
/// nothing crosses, its triangles are well shaped and few.
std::string reason_against_volume(const RepairedSurface& surface);

/// The same from the tets, before any weight is solved for: their angles bound the conditioning,
/// their number and that of the handles the seconds and the memory.
std::string reason_against_tets(const TetMesh& tets, Index handle_count);

/// Predicted seconds, on one thread, of bounded weights in a mesh: one factorization of the
/// biharmonic energy in single precision takes about 0.1 s at 12,000 vertices and grows with the
/// square of their number; a column takes about six of them.
double predicted_seconds(Index vertices, Index handle_count);

} // namespace bindpose

#endif
