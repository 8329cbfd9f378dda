#include "poser/make_poser.h"

#include "poser/mesh_posers.h"
#include "poser/reduced_poser.h"
#include "poser/skinning_poser.h"

namespace bindpose
{

std::unique_ptr<Poser> make_poser(PoseMethod method, std::shared_ptr<const PoseSource> source)
{
  switch (method)
  {
    case PoseMethod::reduced_arap:
      return std::make_unique<ReducedPoser>(std::move(source));
    case PoseMethod::full_arap:
      return std::make_unique<FullPoser>(std::move(source));
    case PoseMethod::variational:
      return std::make_unique<VariationalPoser>(std::move(source));
    default:
      return std::make_unique<SkinningPoser>(std::move(source));
  }
}

bool same_poser(PoseMethod a, PoseMethod b)
{
  return a == b || (is_skinning(a) && is_skinning(b));
}

} // namespace bindpose
