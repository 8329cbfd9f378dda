#include "document/options.h"

#include <QtGlobal>

#include <cmath>
#include <limits>

namespace
{
constexpr double any = std::numeric_limits<double>::max();
constexpr double columns = 1e6;
const QVariant z_axis = QVariantList{ 0.0, 0.0, 1.0 };

/// Return three finite numbers of length one, with a tolerance for rounding by hand; invalid
/// otherwise.
QVariant checked_direction(const QVariant& value)
{
  const QVariantList given = value.toList();
  QVariantList direction;
  double square = 0.0;
  for (const QVariant& each : given)
  {
    bool is_number = false;
    const double number = each.type() == QVariant::Bool ? 0.0 : each.toDouble(&is_number);
    if (!is_number)
    {
      return {};
    }
    square += number * number;
    direction << number;
  }
  constexpr double least_digits = 1e-6;
  return direction.size() == 3 && std::abs(square - 1.0) <= least_digits ? QVariant(direction)
                                                                         : QVariant();
}
} // namespace

const std::vector<OptionInfo>& option_table()
{
  static const std::vector<OptionInfo> table = {
    { "bind.method", QT_TRANSLATE_NOOP("Document", "kind of weights"), 0, 0, 1 },
    { "bind.domain", QT_TRANSLATE_NOOP("Document", "domain of weights"), 0, 0, 4 },
    { "pose.method", QT_TRANSLATE_NOOP("Document", "way to pose"), 0, 0, 31 },
    { "pose.endpoints", QT_TRANSLATE_NOOP("Document", "place along bones"), 0, 0, 2 },
    { "pose.pseudo_edges", QT_TRANSLATE_NOOP("Document", "what turns points"), 1, 0, 2 },
    { "pose.single_precision", QT_TRANSLATE_NOOP("Document", "precision"), false },
    { "pose.in_tets", QT_TRANSLATE_NOOP("Document", "energy of the volume"), false },
    { "pose.energy", QT_TRANSLATE_NOOP("Document", "what is rigid"), 0, 0, 3 },
    { "pose.extra_weights", QT_TRANSLATE_NOOP("Document", "extra weights"), 0.0, 0.0, 30.0 },
    { "pose.extra_kind", QT_TRANSLATE_NOOP("Document", "kind of extra weights"), 0, 0, 1 },
    { "pose.iterations", QT_TRANSLATE_NOOP("Document", "iterations"), 100.0, 1.0, 200.0 },
    { "pose.budget_us", QT_TRANSLATE_NOOP("Document", "time of a solve"), 0.0, 0.0, 5000.0 },
    { "pose.rotations", QT_TRANSLATE_NOOP("Document", "rotations shown"), 0, 0, 2 },
    { "pose.order", QT_TRANSLATE_NOOP("Document", "order of the surface"), 1, 0, 2 },
    { "pose.boundary", QT_TRANSLATE_NOOP("Document", "edge of the surface"), 0, 0, 2 },
    { "pose.compared", QT_TRANSLATE_NOOP("Document", "comparison"), 0, 0, 31 },
    { "pose.ghost", QT_TRANSLATE_NOOP("Document", "place of the comparison"), 2, 0, 2 },
    { "pose.moves", QT_TRANSLATE_NOOP("Document", "motion"), false },
    { "motion.gravity", QT_TRANSLATE_NOOP("Document", "gravity"), 0.5, 0.0, 5.0 },
    { "motion.down", QT_TRANSLATE_NOOP("Document", "direction of gravity"), 1, 0, 2 },
    { "motion.stiffness", QT_TRANSLATE_NOOP("Document", "stiffness"), 2.0, 0.0, 5.0 },
    { "motion.damping", QT_TRANSLATE_NOOP("Document", "damping"), 0.5, 0.0, 20.0 },
    { "show.column", QT_TRANSLATE_NOOP("Document", "what is shown"), 0, 0, columns },
    { "show.outlines", QT_TRANSLATE_NOOP("Document", "outlines"), true },
    { "weights.column", QT_TRANSLATE_NOOP("Document", "handle looked at"), 0, 0, columns },
    { "weights.bands", QT_TRANSLATE_NOOP("Document", "bands"), true },
    { "weights.isolines", QT_TRANSLATE_NOOP("Document", "isolines"), true },
    { "weights.extrema", QT_TRANSLATE_NOOP("Document", "extrema"), false },
    { "weights.what", QT_TRANSLATE_NOOP("Document", "what is looked at"), 0, 0, 2 },
    { "weights.raw", QT_TRANSLATE_NOOP("Document", "raw weights"), 0, 0, 1 },
    { "weights.compare_with", QT_TRANSLATE_NOOP("Document", "method to compare with"), 1, 0, 63 },
    { "weights.slice", QT_TRANSLATE_NOOP("Document", "slice of weights"), false },
    { "weights.orientation", QT_TRANSLATE_NOOP("Document", "slice of weights turned"), 2, 0, 3 },
    { "weights.place", QT_TRANSLATE_NOOP("Document", "move the slice of weights"), 0.5, 0.0, 1.0 },
    { "weights.normal", QT_TRANSLATE_NOOP("Document", "turn the slice of weights"), z_axis },
    { "weights.over_picture", QT_TRANSLATE_NOOP("Document", "colors over the picture"), 0.5, 0.0,
      1.0 },
    { "tets.method", QT_TRANSLATE_NOOP("Document", "way to make tets"), 0, 0, 63 },
    { "tets.shown", QT_TRANSLATE_NOOP("Document", "tets shown"), false },
    { "tets.colors", QT_TRANSLATE_NOOP("Document", "colors of tets"), 0, 0, 15 },
    { "tets.cut", QT_TRANSLATE_NOOP("Document", "cut"), true },
    { "tets.other_side", QT_TRANSLATE_NOOP("Document", "side of the cut"), false },
    { "tets.orientation", QT_TRANSLATE_NOOP("Document", "cut turned"), 2, 0, 3 },
    { "tets.place", QT_TRANSLATE_NOOP("Document", "move the cut"), 0.5, 0.0, 1.0 },
    { "tets.normal", QT_TRANSLATE_NOOP("Document", "turn the cut"), z_axis },
    { "tets.shrink", QT_TRANSLATE_NOOP("Document", "size of each tet"), 1.0, 0.1, 1.0 },
    { "defects.shown", QT_TRANSLATE_NOOP("Document", "defects"), false },
    { "volume.samples", QT_TRANSLATE_NOOP("Document", "samples of the volume"), 1, 0, 2 },
    { "volume.slice", QT_TRANSLATE_NOOP("Document", "slice"), true },
    { "volume.orientation", QT_TRANSLATE_NOOP("Document", "slice turned"), 2, 0, 3 },
    { "volume.place", QT_TRANSLATE_NOOP("Document", "move the slice"), 0.5, 0.0, 1.0 },
    { "volume.normal", QT_TRANSLATE_NOOP("Document", "turn the slice"), z_axis },
    { "volume.isosurface", QT_TRANSLATE_NOOP("Document", "isosurface"), false },
    { "volume.level", QT_TRANSLATE_NOOP("Document", "level of the isosurface"), 0.5, -any, any },
    { "volume.cloud", QT_TRANSLATE_NOOP("Document", "cloud"), false },
    { "volume.surface_look", QT_TRANSLATE_NOOP("Document", "look of the surface"), 1, 0, 3 },
  };
  return table;
}

const OptionInfo* find_option(const QString& key)
{
  for (const OptionInfo& option : option_table())
  {
    if (key == QLatin1String(option.key))
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
