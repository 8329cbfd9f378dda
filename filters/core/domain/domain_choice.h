#ifndef bindpose_domain_domain_choice_h
#define bindpose_domain_domain_choice_h

#include "surface/surface_repair.h"

#include <string>

namespace bindpose
{

/// Predict whether solving weights in conforming tets, which fill the inside of the surface, will
/// be well conditioned and cheap. The prediction uses only the surface, before any tet is made.
/// @return an empty string if the prediction is positive: the surface is closed and clean, and has
/// few, well-shaped triangles. Otherwise, the reason why conforming tets should not be used, as
/// text for the report.
std::string reason_against_volume(const RepairedSurface& surface);

/// Predict from the tets whether solving weights in them will be well conditioned and cheap. The
/// conditioning is judged by the dihedral angles of the tets. The time is predicted from the number
/// of vertices and the number of handles.
/// @return an empty string if the prediction is positive. Otherwise, the reason why the tets should
/// not be used, as text for the report.
std::string reason_against_tets(const TetMesh& tets, Index handle_count);

/// Return the predicted time in seconds, on one thread, for bounded weights in a mesh. One
/// factorization of the biharmonic energy in single precision takes about 0.1 s at 12,000 vertices,
/// and its time grows with the square of the number of vertices. The prediction is the time of six
/// factorizations per column and of two further factorizations.
double predicted_seconds(Index vertices, Index handle_count);

} // namespace bindpose

#endif
