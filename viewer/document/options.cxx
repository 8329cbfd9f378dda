#include "document/options.h"

#include "document/stage_options.h"

#include "poser/body.h"
#include "poser/pose_options.h"
#include "weights/weight_methods.h"

#include <QtGlobal>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace
{
constexpr double unlimited = std::numeric_limits<double>::max();
constexpr double column_limit = 1e6;
const QVariant z_axis = QVariantList{ 0.0, 0.0, 1.0 };

/// Return a direction if it consists of three numbers with norm one; otherwise an invalid variant.
/// The norm may deviate slightly, because users round the numbers.
QVariant checked_direction(const QVariant& value)
{
  const QVariantList components = value.toList();
  QVariantList direction;
  double squared_norm = 0.0;
  for (const QVariant& component : components)
  {
    bool is_number = false;
    const bool has_other_type =
      component.type() == QVariant::Bool || component.type() == QVariant::String;
    const double number = has_other_type ? 0.0 : component.toDouble(&is_number);
    if (!is_number)
    {
      return {};
    }
    squared_norm += number * number;
    direction << number;
  }
  constexpr double norm_tolerance = 1e-6;
  return direction.size() == 3 && std::abs(squared_norm - 1.0) <= norm_tolerance
    ? QVariant(direction)
    : QVariant();
}

/// Return the weight methods, in the order of the registry.
/// @param constrained  true: return only the bounded and monotone methods, which are first in the
/// registry
std::vector<OptionChoice> weight_method_choices(bool constrained)
{
  std::vector<OptionChoice> choices;
  for (const bindpose::WeightMethod& method : bindpose::weight_methods())
  {
    if (method.constrained || !constrained)
    {
      choices.push_back({ method.word, method.label });
    }
  }
  return choices;
}

/// Return the pose methods, in the order of bindpose::PoseMethod.
std::vector<OptionChoice> pose_method_choices()
{
  const std::vector<OptionChoice>& described = stage_options::pose_method::method.choices;
  std::vector<OptionChoice> choices;
  for (int k = 0; k < bindpose::pose_method_count; ++k)
  {
    const std::string_view word = bindpose::to_string(static_cast<bindpose::PoseMethod>(k));
    choices.push_back(*std::find_if(described.begin(), described.end(),
      [&](const OptionChoice& choice) { return choice.word == word; }));
  }
  return choices;
}

std::vector<OptionChoice> joined(
  std::vector<OptionChoice> choices, const std::vector<OptionChoice>& further_choices)
{
  choices.insert(choices.end(), further_choices.begin(), further_choices.end());
  return choices;
}

/// Return the table row of an option that is a choice.
OptionInfo choice(const char* key, const char* step, int initial, std::vector<OptionChoice> choices,
  const char* former_key = "")
{
  const auto highest = static_cast<double>(choices.size() - 1);
  return { key, step, initial, 0.0, highest, std::move(choices), former_key };
}

OptionInfo choice(const char* key, const char* step, const stage_options::Choices& described)
{
  return choice(key, step, described.initial, described.choices);
}

/// Return the table row of a numeric option. The initial value and the range of the slider come
/// from the description of the option in filters/options.
OptionInfo number(const char* key, const char* step, const stage_options::Number& described)
{
  return { key, step, described.initial, described.lowest, described.highest };
}

std::vector<OptionInfo> make_option_table()
{
  using namespace stage_options;
  const bindpose::BodyOptions body;
  const std::vector<OptionChoice> orientations = { { "x", QT_TRANSLATE_NOOP("Document", "X") },
    { "y", QT_TRANSLATE_NOOP("Document", "Y") }, { "z", QT_TRANSLATE_NOOP("Document", "Z") },
    { "free", QT_TRANSLATE_NOOP("Document", "Free") } };
  return {
    choice("bind.method", QT_TRANSLATE_NOOP("Document", "type of weights"), 0,
      weight_method_choices(true)),
    choice("bind.domain", QT_TRANSLATE_NOOP("Document", "domain of weights"), weights::domain),
    choice("pose.method", QT_TRANSLATE_NOOP("Document", "pose method"), 0, pose_method_choices()),
    choice("pose.endpoints", QT_TRANSLATE_NOOP("Document", "position along bones"),
      endpoint_weights::method),
    choice(
      "pose.pseudo_edges", QT_TRANSLATE_NOOP("Document", "pseudo-edges"), skinning::pseudo_edges),
    { "pose.single_precision", QT_TRANSLATE_NOOP("Document", "precision"), false },
    { "pose.in_tets", QT_TRANSLATE_NOOP("Document", "keep the volume"), false },
    // "Elements" means tets if the method deforms tets (pose.in_tets), otherwise triangles.
    choice("pose.energy", QT_TRANSLATE_NOOP("Document", "rigid parts"), 0,
      { { "auto", QT_TRANSLATE_NOOP("Document", "Automatic") },
        { "spokes-and-rims", QT_TRANSLATE_NOOP("Document", "Spokes and rims") },
        { "elements", QT_TRANSLATE_NOOP("Document", "Elements") },
        { "spokes", QT_TRANSLATE_NOOP("Document", "Spokes") } }),
    number("pose.extra_weights", QT_TRANSLATE_NOOP("Document", "extra weights"),
      reduced_arap_bind::number_of_extra_weights),
    choice("pose.extra_kind", QT_TRANSLATE_NOOP("Document", "type of extra weights"),
      reduced_arap_bind::extra_weights_kind),
    number(
      "pose.iterations", QT_TRANSLATE_NOOP("Document", "iterations"), arap::maximum_iterations),
    number("pose.budget_us", QT_TRANSLATE_NOOP("Document", "time limit of the solve"),
      time_budget::time_budget),
    choice("pose.rotations", QT_TRANSLATE_NOOP("Document", "rotation colors"), 0,
      { { "none", QT_TRANSLATE_NOOP("Document", "Not shown") },
        { "clusters", QT_TRANSLATE_NOOP("Document", "Clusters") },
        { "angles", QT_TRANSLATE_NOOP("Document", "Angles") } }),
    choice("pose.order", QT_TRANSLATE_NOOP("Document", "surface model"), variational::order.initial,
      { { "membrane", variational::order.choices[0].label },
        { "thin-plate", variational::order.choices[1].label },
        { "third-order", variational::order.choices[2].label } }),
    choice(
      "pose.boundary", QT_TRANSLATE_NOOP("Document", "surface boundary"), variational::boundary),
    choice("pose.compared", QT_TRANSLATE_NOOP("Document", "comparison"), 0,
      joined({ { "none", QT_TRANSLATE_NOOP("Document", "Nothing") } }, pose_method_choices())),
    choice("pose.ghost", QT_TRANSLATE_NOOP("Document", "comparison style"), 2,
      { { "over", QT_TRANSLATE_NOOP("Document", "Over it") },
        { "beside", QT_TRANSLATE_NOOP("Document", "Beside it") },
        { "distance", QT_TRANSLATE_NOOP("Document", "Distance") } }),
    { "pose.moves", QT_TRANSLATE_NOOP("Document", "simulate motion"), false },
    { "motion.gravity", QT_TRANSLATE_NOOP("Document", "gravity"), body.gravity, 0.0, 5.0 },
    choice("motion.down", QT_TRANSLATE_NOOP("Document", "direction of gravity"), body.down_axis,
      { { "x", QT_TRANSLATE_NOOP("Document", "-x") }, { "y", QT_TRANSLATE_NOOP("Document", "-y") },
        { "z", QT_TRANSLATE_NOOP("Document", "-z") } }),
    { "motion.stiffness", QT_TRANSLATE_NOOP("Document", "stiffness"), std::log10(body.stiffness),
      0.0, 5.0 },
    { "motion.damping", QT_TRANSLATE_NOOP("Document", "damping"), body.damping, 0.0, 20.0 },
    { "show.column", QT_TRANSLATE_NOOP("Document", "displayed weights"), 0, 0, column_limit },
    { "show.outlines", QT_TRANSLATE_NOOP("Document", "outlines"), true },
    { "show.look", QT_TRANSLATE_NOOP("Document", "materials and textures"), true },
    { "weights.column", QT_TRANSLATE_NOOP("Document", "inspected handle"), 0, 0, column_limit },
    { "weights.bands", QT_TRANSLATE_NOOP("Document", "bands"), true },
    { "weights.isolines", QT_TRANSLATE_NOOP("Document", "isolines"), true },
    { "weights.extrema", QT_TRANSLATE_NOOP("Document", "extrema"), false },
    choice("weights.what", QT_TRANSLATE_NOOP("Document", "inspected values"), 0,
      { { "weights", QT_TRANSLATE_NOOP("Document", "Weights") },
        { "row-sums", QT_TRANSLATE_NOOP("Document", "Row sums") },
        { "difference", QT_TRANSLATE_NOOP("Document", "Difference") } }),
    choice("weights.raw", QT_TRANSLATE_NOOP("Document", "raw weights"), 0,
      { { "normalized", QT_TRANSLATE_NOOP("Document", "Normalized") },
        { "raw", QT_TRANSLATE_NOOP("Document", "Raw") } }),
    choice("weights.compare_with", QT_TRANSLATE_NOOP("Document", "method to compare with"), 1,
      weight_method_choices(false)),
    { "weights.slice", QT_TRANSLATE_NOOP("Document", "slice of weights"), false },
    choice("weights.orientation",
      QT_TRANSLATE_NOOP("Document", "orientation of the slice of weights"), 2, orientations),
    { "weights.place", QT_TRANSLATE_NOOP("Document", "move the slice of weights"), 0.5, 0.0, 1.0 },
    { "weights.normal", QT_TRANSLATE_NOOP("Document", "turn the slice of weights"), z_axis },
    { "weights.over_picture", QT_TRANSLATE_NOOP("Document", "opacity of the colors"), 0.5, 0.0,
      1.0 },
    choice("tets.method", QT_TRANSLATE_NOOP("Document", "tet method"), 0,
      joined(tetrahedralize::method.choices,
        { { "hull", QT_TRANSLATE_NOOP("Document", "Whole hull (cdt)") } })),
    { "tets.shown", QT_TRANSLATE_NOOP("Document", "show tets"), false },
    choice("tets.colors", QT_TRANSLATE_NOOP("Document", "colors of tets"), 0,
      { { "plain", QT_TRANSLATE_NOOP("Document", "Plain") },
        { "winding-number", QT_TRANSLATE_NOOP("Document", "By winding number") },
        { "label", QT_TRANSLATE_NOOP("Document", "By label") },
        { "quality", QT_TRANSLATE_NOOP("Document", "By quality") },
        { "method", QT_TRANSLATE_NOOP("Document", "By method") } },
      "tets.colours"),
    { "tets.cut", QT_TRANSLATE_NOOP("Document", "cut"), true },
    { "tets.other_side", QT_TRANSLATE_NOOP("Document", "kept side of the cut"), false },
    choice(
      "tets.orientation", QT_TRANSLATE_NOOP("Document", "orientation of the cut"), 2, orientations),
    { "tets.place", QT_TRANSLATE_NOOP("Document", "move the cut"), 0.5, 0.0, 1.0 },
    { "tets.normal", QT_TRANSLATE_NOOP("Document", "turn the cut"), z_axis },
    { "tets.shrink", QT_TRANSLATE_NOOP("Document", "size of each tet"), 1.0, 0.1, 1.0 },
    { "defects.shown", QT_TRANSLATE_NOOP("Document", "defects"), false },
    choice("volume.samples", QT_TRANSLATE_NOOP("Document", "samples of the volume"), 1,
      { { "coarse", QT_TRANSLATE_NOOP("Document", "Coarse") },
        { "medium", QT_TRANSLATE_NOOP("Document", "Medium") },
        { "fine", QT_TRANSLATE_NOOP("Document", "Fine") } }),
    { "volume.slice", QT_TRANSLATE_NOOP("Document", "slice"), true },
    choice("volume.orientation", QT_TRANSLATE_NOOP("Document", "orientation of the slice"), 2,
      orientations),
    { "volume.place", QT_TRANSLATE_NOOP("Document", "move the slice"), 0.5, 0.0, 1.0 },
    { "volume.normal", QT_TRANSLATE_NOOP("Document", "turn the slice"), z_axis },
    { "volume.isosurface", QT_TRANSLATE_NOOP("Document", "isosurface"), false },
    { "volume.level", QT_TRANSLATE_NOOP("Document", "level of the isosurface"), 0.5, -unlimited,
      unlimited },
    { "volume.cloud", QT_TRANSLATE_NOOP("Document", "cloud"), false },
    choice("volume.surface_look", QT_TRANSLATE_NOOP("Document", "surface style"), 1,
      { { "solid", QT_TRANSLATE_NOOP("Document", "Solid") },
        { "see-through", QT_TRANSLATE_NOOP("Document", "See-through") },
        { "edges", QT_TRANSLATE_NOOP("Document", "Edges only") },
        { "hidden", QT_TRANSLATE_NOOP("Document", "Hidden") } }),
  };
}
} // namespace

const std::vector<OptionInfo>& option_table()
{
  static const std::vector<OptionInfo> table = make_option_table();
  return table;
}

const OptionInfo* find_option(const QString& key)
{
  for (const OptionInfo& option : option_table())
  {
    if (key == QLatin1String(option.key) ||
      (option.former_key[0] && key == QLatin1String(option.former_key)))
    {
      return &option;
    }
  }
  return nullptr;
}

Options initial_options()
{
  Options options;
  for (const OptionInfo& option : option_table())
  {
    options[option.key] = option.initial;
  }
  return options;
}

QVariant checked_option(const OptionInfo& option, const QVariant& value)
{
  if (option.initial.type() == QVariant::Bool)
  {
    return value.type() == QVariant::Bool ? value : QVariant();
  }
  if (option.initial.type() == QVariant::List)
  {
    return checked_direction(value);
  }
  if (value.type() == QVariant::String)
  {
    for (std::size_t i = 0; i < option.choices.size(); ++i)
    {
      if (value.toString() == QLatin1String(option.choices[i].word))
      {
        return static_cast<int>(i);
      }
    }
    return {};
  }
  bool is_number = false;
  const double number = value.type() == QVariant::Bool ? 0.0 : value.toDouble(&is_number);
  if (!is_number || !(number >= option.lowest && number <= option.highest))
  {
    return {};
  }
  if (option.initial.type() == QVariant::Int)
  {
    return std::floor(number) == number ? QVariant(static_cast<int>(number)) : QVariant();
  }
  return number;
}
