#ifndef bindpose_poser_make_poser_h
#define bindpose_poser_make_poser_h

#include "poser/poser.h"

namespace bindpose
{

/// Return the poser of a method. The four skinning methods use one type of poser.
std::unique_ptr<Poser> make_poser(PoseMethod method, std::shared_ptr<const PoseSource> source);
/// Report whether the same type of poser implements both methods.
bool same_poser(PoseMethod a, PoseMethod b);

} // namespace bindpose

#endif
