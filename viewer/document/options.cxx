#include "document/options.h"

#include "weights/weight_methods.h"

#include <QtGlobal>

#include <cmath>
#include <limits>

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

/// Return the words of the weight methods, in the order of the registry.
/// @param constrained  true: return only the bounded and monotone methods, which are first in the
/// registry
std::vector<const char*> method_words(bool constrained)
{
  std::vector<const char*> words;
  for (const bindpose::WeightMethod& method : bindpose::weight_methods())
  {
    if (method.constrained || !constrained)
    {
      words.push_back(method.word);
    }
  }
  return words;
}

std::vector<OptionInfo> make_option_table()
{
  std::vector<OptionInfo> table = {
    { "bind.method", QT_TRANSLATE_NOOP("Document", "type of weights"), 0, 0, unlimited,
      method_words(true) },
    { "bind.domain", QT_TRANSLATE_NOOP("Document", "domain of weights"), 0, 0, 4,
      { "auto", "volume", "embedding", "cage", "surface" } },
    { "pose.method", QT_TRANSLATE_NOOP("Document", "pose method"), 0, 0, 6,
      { "lbs", "dqs", "reduced-arap", "stbs", "cor", "full-arap", "variational" } },
    { "pose.endpoints", QT_TRANSLATE_NOOP("Document", "position along bones"), 0, 0, 2,
      { "projection", "joints", "bounded" } },
    { "pose.pseudo_edges", QT_TRANSLATE_NOOP("Document", "pseudo-edges"), 1, 0, 2,
      { "none", "given", "auto" } },
    { "pose.single_precision", QT_TRANSLATE_NOOP("Document", "precision"), false },
    { "pose.in_tets", QT_TRANSLATE_NOOP("Document", "keep the volume"), false },
    { "pose.energy", QT_TRANSLATE_NOOP("Document", "rigid parts"), 0, 0, 3,
      { "auto", "spokes-and-rims", "elements", "spokes" } },
    { "pose.extra_weights", QT_TRANSLATE_NOOP("Document", "extra weights"), 0.0, 0.0, 30.0 },
    { "pose.extra_kind", QT_TRANSLATE_NOOP("Document", "type of extra weights"), 0, 0, 1,
      { "bumps", "eigenmodes" } },
    { "pose.iterations", QT_TRANSLATE_NOOP("Document", "iterations"), 100.0, 1.0, 200.0 },
    { "pose.budget_us", QT_TRANSLATE_NOOP("Document", "time limit of the solve"), 0.0, 0.0,
      5000.0 },
    { "pose.rotations", QT_TRANSLATE_NOOP("Document", "rotation colors"), 0, 0, 2,
      { "none", "clusters", "angles" } },
    { "pose.order", QT_TRANSLATE_NOOP("Document", "surface model"), 1, 0, 2,
      { "membrane", "thin-plate", "third-order" } },
    { "pose.boundary", QT_TRANSLATE_NOOP("Document", "surface boundary"), 0, 0, 2,
      { "region", "curve", "tangent" } },
    { "pose.compared", QT_TRANSLATE_NOOP("Document", "comparison"), 0, 0, 7,
      { "none", "lbs", "dqs", "reduced-arap", "stbs", "cor", "full-arap", "variational" } },
    { "pose.ghost", QT_TRANSLATE_NOOP("Document", "comparison style"), 2, 0, 2,
      { "over", "beside", "distance" } },
    { "pose.moves", QT_TRANSLATE_NOOP("Document", "simulate motion"), false },
    { "motion.gravity", QT_TRANSLATE_NOOP("Document", "gravity"), 0.5, 0.0, 5.0 },
    { "motion.down", QT_TRANSLATE_NOOP("Document", "direction of gravity"), 1, 0, 2,
      { "x", "y", "z" } },
    { "motion.stiffness", QT_TRANSLATE_NOOP("Document", "stiffness"), 2.0, 0.0, 5.0 },
    { "motion.damping", QT_TRANSLATE_NOOP("Document", "damping"), 0.5, 0.0, 20.0 },
    { "show.column", QT_TRANSLATE_NOOP("Document", "displayed weights"), 0, 0, column_limit },
    { "show.outlines", QT_TRANSLATE_NOOP("Document", "outlines"), true },
    { "weights.column", QT_TRANSLATE_NOOP("Document", "inspected handle"), 0, 0, column_limit },
    { "weights.bands", QT_TRANSLATE_NOOP("Document", "bands"), true },
    { "weights.isolines", QT_TRANSLATE_NOOP("Document", "isolines"), true },
    { "weights.extrema", QT_TRANSLATE_NOOP("Document", "extrema"), false },
    { "weights.what", QT_TRANSLATE_NOOP("Document", "inspected values"), 0, 0, 2,
      { "weights", "row-sums", "difference" } },
    { "weights.raw", QT_TRANSLATE_NOOP("Document", "raw weights"), 0, 0, 1,
      { "normalized", "raw" } },
    { "weights.compare_with", QT_TRANSLATE_NOOP("Document", "method to compare with"), 1, 0,
      unlimited, method_words(false) },
    { "weights.slice", QT_TRANSLATE_NOOP("Document", "slice of weights"), false },
    { "weights.orientation", QT_TRANSLATE_NOOP("Document", "orientation of the slice of weights"),
      2, 0, 3, { "x", "y", "z", "free" } },
    { "weights.place", QT_TRANSLATE_NOOP("Document", "move the slice of weights"), 0.5, 0.0, 1.0 },
    { "weights.normal", QT_TRANSLATE_NOOP("Document", "turn the slice of weights"), z_axis },
    { "weights.over_picture", QT_TRANSLATE_NOOP("Document", "colors over the picture"), 0.5, 0.0,
      1.0 },
    { "tets.method", QT_TRANSLATE_NOOP("Document", "tet method"), 0, 0, 6,
      { "auto", "cdt", "remesh", "embed", "wrap", "ftetwild", "hull" } },
    { "tets.shown", QT_TRANSLATE_NOOP("Document", "show tets"), false },
    { "tets.colors", QT_TRANSLATE_NOOP("Document", "colors of tets"), 0, 0, 4,
      { "plain", "winding-number", "label", "quality", "method" }, "tets.colours" },
    { "tets.cut", QT_TRANSLATE_NOOP("Document", "cut"), true },
    { "tets.other_side", QT_TRANSLATE_NOOP("Document", "side of the cut"), false },
    { "tets.orientation", QT_TRANSLATE_NOOP("Document", "orientation of the cut"), 2, 0, 3,
      { "x", "y", "z", "free" } },
    { "tets.place", QT_TRANSLATE_NOOP("Document", "move the cut"), 0.5, 0.0, 1.0 },
    { "tets.normal", QT_TRANSLATE_NOOP("Document", "turn the cut"), z_axis },
    { "tets.shrink", QT_TRANSLATE_NOOP("Document", "size of each tet"), 1.0, 0.1, 1.0 },
    { "defects.shown", QT_TRANSLATE_NOOP("Document", "defects"), false },
    { "volume.samples", QT_TRANSLATE_NOOP("Document", "samples of the volume"), 1, 0, 2,
      { "coarse", "medium", "fine" } },
    { "volume.slice", QT_TRANSLATE_NOOP("Document", "slice"), true },
    { "volume.orientation", QT_TRANSLATE_NOOP("Document", "orientation of the slice"), 2, 0, 3,
      { "x", "y", "z", "free" } },
    { "volume.place", QT_TRANSLATE_NOOP("Document", "move the slice"), 0.5, 0.0, 1.0 },
    { "volume.normal", QT_TRANSLATE_NOOP("Document", "turn the slice"), z_axis },
    { "volume.isosurface", QT_TRANSLATE_NOOP("Document", "isosurface"), false },
    { "volume.level", QT_TRANSLATE_NOOP("Document", "level of the isosurface"), 0.5, -unlimited,
      unlimited },
    { "volume.cloud", QT_TRANSLATE_NOOP("Document", "cloud"), false },
    { "volume.surface_look", QT_TRANSLATE_NOOP("Document", "surface style"), 1, 0, 3,
      { "solid", "see-through", "edges", "hidden" } },
  };
  for (OptionInfo& option : table)
  {
    if (!option.words.empty())
    {
      option.highest = static_cast<double>(option.words.size() - 1);
    }
  }
  return table;
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
    for (std::size_t i = 0; i < option.words.size(); ++i)
    {
      if (value.toString() == QLatin1String(option.words[i]))
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
