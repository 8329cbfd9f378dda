// Weights in the window, as a user inspects them. Most tests use weights that are linear along z,
// so the expected values, counts and positions in the view are known. For comparisons of weight
// methods, the expected values are results of the kernels.
#include "app/weights/binding.h"
#include "unclipped.h"
#include "window_test.h"

#include "app/handles/side_panel.h"
#include "app/parts/value_row.h"
#include "app/weights/weight_inspection.h"
#include "app/weights/weight_panel.h"
#include "document/opened_file.h"

#include "conversion.h"
#include "report_field_data.h"
#include "scene/categories.h"
#include "scene/colors.h"
#include "weights/unconstrained_weights.h"

#include "support/meshes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkUnstructuredGrid.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QThread>

#include <cmath>
#include <cstdio>
#include <set>

using namespace bindpose;
using test::two_points;

namespace
{
using Column = std::function<double(const Vec3&)>;

double top_weight(const Vec3& p)
{
  return 0.5 * (1.0 + p.z());
}

double bottom_weight(const Vec3& p)
{
  return 1.0 - top_weight(p);
}

void add_array(vtkDataSet* data, const char* name, const std::vector<Column>& columns)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    array->SetComponentName(static_cast<vtkIdType>(c), c == 0 ? "bottom" : "top");
  }
  for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v)
  {
    for (const Column& column : columns)
    {
      array->InsertNextValue(column(Vec3(data->GetPoint(v))));
    }
  }
  data->GetPointData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> ball_with_named_weights()
{
  const TriangleMesh mesh = test::sphere(4);
  auto data = to_polydata(mesh.points, mesh.triangles);
  add_array(data, "Weights", { bottom_weight, top_weight });
  return data;
}

/// Return a box of tets around the origin, with weights linear along z.
vtkSmartPointer<vtkUnstructuredGrid> box_with_named_weights()
{
  const TetMesh mesh = test::tet_box(8, 8, 8, Vec3(-1, -1, -1), Vec3(1, 1, 1));
  auto grid = to_unstructured_grid(mesh.points, mesh.tets);
  add_array(grid, "Weights", { bottom_weight, top_weight });
  return grid;
}

double hue_distance(const QColor& c, const Rgb& color)
{
  const double component_sum = std::max(1, c.red() + c.green() + c.blue());
  const double sum = color[0] + color[1] + color[2];
  return std::max({ std::abs(c.red() / component_sum - color[0] / sum),
    std::abs(c.green() / component_sum - color[1] / sum),
    std::abs(c.blue() / component_sum - color[2] / sum) });
}

class WeightWindow : public test::WindowTest
{
protected:
  app::weights::WeightInspection* weights() { return this->part<app::weights::WeightInspection>(); }
  app::weights::WeightView* view() { return this->weights()->view(); }
  app::weights::WeightPanel* panel() { return this->part<app::window::PanelColumn>()->weight(); }
  app::parts::ValueRow* row() { return this->panel()->findChild<app::parts::ValueRow*>(); }
  vtkActor* surface() { return this->part<app::view::Viewport>()->surface_actor(); }
  QComboBox* list(const QString& item)
  {
    for (QComboBox* candidate : this->panel()->findChildren<QComboBox*>())
    {
      if (candidate->findText(item) >= 0)
      {
        return candidate;
      }
    }
    ADD_FAILURE() << "no list has " << item.toStdString();
    return nullptr;
  }
  void choose(const QString& item) { this->list(item)->setCurrentText(item); }
  QPushButton* button(const QString& text)
  {
    for (QPushButton* candidate : this->panel()->findChildren<QPushButton*>())
    {
      if (candidate->text() == text)
      {
        return candidate;
      }
    }
    ADD_FAILURE() << "there is no " << text.toStdString();
    return nullptr;
  }
  bool has_label_with(const QString& words)
  {
    for (QLabel* label : this->panel()->findChildren<QLabel*>())
    {
      if (label->text().contains(words))
      {
        return true;
      }
    }
    return false;
  }

  void open(vtkDataSet* mesh)
  {
    ASSERT_TRUE(this->window.set_mesh(mesh, "mesh")) << this->window.error().toStdString();
    this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::weights);
    this->render();
  }
  template <typename Condition>
  void wait_while(const Condition& condition)
  {
    QElapsedTimer clock;
    clock.start();
    do
    {
      QThread::msleep(5);
      QApplication::processEvents();
    } while (condition() && clock.elapsed() < 60000);
    QApplication::processEvents();
  }
  QColor color_at(const Vec3& position)
  {
    return this->picture().pixelColor(this->pixel(position));
  }
};
} // namespace

TEST_F(WeightWindow, AColumnHasBandsAndIsolinesAtEveryTenth)
{
  this->open(ball_with_named_weights());
  this->choose("top");
  // The weights are linear on every triangle. The isolines are at 0.1, …, 0.9 of the height.
  vtkPolyData* lines = this->view()->isolines();
  std::set<long> levels;
  for (vtkIdType v = 0; v < lines->GetNumberOfPoints(); ++v)
  {
    const double tenths = 10.0 * top_weight(Vec3(lines->GetPoint(v)));
    EXPECT_NEAR(tenths, std::round(tenths), 1e-4);
    levels.insert(std::lround(tenths));
  }
  EXPECT_EQ(levels, (std::set<long>{ 1, 2, 3, 4, 5, 6, 7, 8, 9 }));
  const auto colors = [this]
  {
    return vtkLookupTable::SafeDownCast(this->surface()->GetMapper()->GetLookupTable())
      ->GetNumberOfTableValues();
  };
  EXPECT_EQ(colors(), 10);
  this->find<QCheckBox>("Bands")->setChecked(false);
  EXPECT_GT(colors(), 100);
  EXPECT_GT(lines->GetNumberOfPoints(), 0);
  this->find<QCheckBox>("Isolines")->setChecked(false);
  EXPECT_EQ(lines->GetNumberOfPoints(), 0);
  // If another panel is open, the surface is shaded without weights.
  this->find<QPushButton>("Pose")->click();
  EXPECT_FALSE(this->surface()->GetMapper()->GetScalarVisibility());
}

TEST_F(WeightWindow, AllShowsTheStrongestHandle)
{
  this->open(ball_with_named_weights());
  this->choose("All: strongest handle");
  const std::vector<Category> handles = handle_categories({ "bottom", "top" });
  // Viewed from the side, each half of the ball has the color of one handle.
  this->part<app::view::Viewport>()->renderer()->GetActiveCamera()->Azimuth(90.0);
  const QImage image = this->picture();
  int bottom_pixels = 0;
  int top_pixels = 0;
  for (int y = 0; y < image.height(); y += 2)
  {
    for (int x = image.width() / 3; x < 2 * image.width() / 3; x += 2)
    {
      const QColor c = image.pixelColor(x, y);
      bottom_pixels += hue_distance(c, handles[0].color) < 0.06;
      top_pixels += hue_distance(c, handles[1].color) < 0.06;
    }
  }
  EXPECT_GT(bottom_pixels, 2000);
  EXPECT_GT(top_pixels, 2000);
  EXPECT_FALSE(this->find<QCheckBox>("Bands")->isEnabled());
  EXPECT_FALSE(this->find<QCheckBox>("Bands")->toolTip().isEmpty());
}

TEST_F(WeightWindow, RowSumsNeedRawColumns)
{
  this->open(ball_with_named_weights());
  EXPECT_FALSE(this->button("Row sums")->isEnabled());
  EXPECT_TRUE(this->button("Row sums")->toolTip().contains("--keep-raw"));
  EXPECT_FALSE(this->button("Raw")->isEnabled());
  const auto raw = ball_with_named_weights();
  add_array(raw, "RawWeights",
    { bottom_weight, [](const Vec3& p) { return top_weight(p) + 0.25 * p.z(); } });
  this->open(raw);
  this->button("Row sums")->click();
  EXPECT_NEAR(this->view()->numbers().number("picture.row_sum.minimum", 0.0), 0.75, 1e-12);
  EXPECT_NEAR(this->view()->numbers().number("picture.row_sum.maximum", 0.0), 1.25, 1e-12);
  EXPECT_FALSE(this->list("top")->isEnabled());
  EXPECT_FALSE(this->button("Normalized")->isEnabled());
  // Row sums need the array RawWeights. After a mesh without this array is opened, the view shows
  // the array Weights.
  this->open(ball_with_named_weights());
  EXPECT_TRUE(this->button("Weights")->isChecked());
  EXPECT_TRUE(this->view()->is_shown());
}

TEST_F(WeightWindow, ExtremaAreCountedAndSeen)
{
  // The array RawWeights has an extremum that the array Weights does not have: a bump in the middle
  // of the visible side.
  const Vec3 position = Vec3(0.3, -0.5, 0.1).normalized();
  Vec3 bump = position;
  const auto mesh = ball_with_named_weights();
  double nearest = 1e300;
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    const Vec3 p(mesh->GetPoint(v));
    if ((p - position).norm() < nearest)
    {
      nearest = (p - position).norm();
      bump = p;
    }
  }
  add_array(mesh, "RawWeights", { bottom_weight, [bump](const Vec3& p) {
                                   return top_weight(p) +
                                     0.3 * std::exp(-40.0 * (p - bump).squaredNorm());
                                 } });
  this->open(mesh);
  this->choose("top");
  this->find<QCheckBox>("Extrema away from handles")->setChecked(true);
  // A weight is exactly 1 at its own handle, which is at a pole. At the other pole it is 0, which
  // is the minimum.
  EXPECT_TRUE(this->has_label_with("Maxima: 0, minima: "));
  this->button("Raw")->click();
  EXPECT_TRUE(this->has_label_with("Maxima: 1, minima: "));
  bool found = false;
  for (const Extremum& extremum : this->view()->extrema())
  {
    found =
      found || (extremum.maximum && (Vec3(mesh->GetPoint(extremum.vertex)) - bump).norm() < 0.1);
  }
  EXPECT_TRUE(found);
  // The ball that marks the extremum is visible at the position of the extremum. Clearing the check
  // box hides the ball.
  const Rgb red = extremum_categories()[1].color;
  const auto count_red_pixels = [&]
  {
    const QImage image = this->picture();
    const QPoint middle = this->pixel(bump);
    int seen = 0;
    for (int dy = -12; dy <= 12; ++dy)
    {
      for (int dx = -12; dx <= 12; ++dx)
      {
        seen += hue_distance(image.pixelColor(middle + QPoint(dx, dy)), red) < 0.1;
      }
    }
    return seen;
  };
  const Vec3 eye(this->part<app::view::Viewport>()->renderer()->GetActiveCamera()->GetPosition());
  if (eye.dot(bump) < 0.0)
  {
    this->part<app::view::Viewport>()->renderer()->GetActiveCamera()->Azimuth(180.0);
  }
  EXPECT_GT(count_red_pixels(), 20);
  this->find<QCheckBox>("Extrema away from handles")->setChecked(false);
  EXPECT_EQ(count_red_pixels(), 0);
}

TEST_F(WeightWindow, ASliceThroughTheVolumeFollowsTheMouse)
{
  this->open(box_with_named_weights());
  this->choose("top");
  EXPECT_EQ(this->surface()->GetProperty()->GetOpacity(), 1.0);
  this->find<QCheckBox>("Slice through the volume")->setChecked(true);
  EXPECT_LT(this->surface()->GetProperty()->GetOpacity(), 0.5);
  this->button("X")->click();
  this->row()->field()->setValue(0.1);
  this->render();
  const auto check = [this](int axis, double at)
  {
    vtkPolyData* slice = this->view()->slice();
    vtkDataArray* values = slice->GetPointData()->GetArray("bindpose.Color");
    ASSERT_NE(values, nullptr);
    EXPECT_GT(slice->GetNumberOfCells(), 100);
    for (vtkIdType v = 0; v < slice->GetNumberOfPoints(); ++v)
    {
      const Vec3 p(slice->GetPoint(v));
      EXPECT_NEAR(p[axis], at, 1e-6);
      EXPECT_NEAR(values->GetComponent(v, 0), top_weight(p), 1e-6);
    }
  };
  check(0, 0.1);
  this->button("Z")->click();
  this->row()->field()->setValue(-0.2);
  this->render();
  check(2, -0.2);
  this->drag(this->pixel(Vec3(0.4, 0.3, -0.2)), this->pixel(Vec3(0.4, 0.3, 0.4)));
  EXPECT_NEAR(this->view()->plane()->position(), 0.4, 0.1);
  EXPECT_NEAR(this->row()->value(), this->view()->plane()->position(), 0.01);
  check(2, this->view()->plane()->position());
  // The slice is drawn without lighting, and the surface over it is translucent. The visible color
  // of the slice is therefore close to the legend's color for the weight.
  const ColorMap map = weight_map();
  const double z = this->view()->plane()->position();
  EXPECT_LT(
    hue_distance(this->color_at(Vec3(0.1, 0.2, z)), color_of(map, top_weight({ 0, 0, z }))), 0.08);
  // Both ends of the slider are valid. If all handles are chosen, the slice shows the strongest
  // handle.
  for (const double end : { -1.0, 1.0 })
  {
    this->row()->field()->setValue(end);
    this->render();
  }
  this->button("X")->click();
  this->choose("All: strongest handle");
  EXPECT_GT(this->view()->slice()->GetNumberOfCells(), 100);
  // While the panel Pose is open, the slice of weights is hidden and the surface is opaque.
  this->find<QPushButton>("Pose")->click();
  EXPECT_FALSE(this->view()->is_shown());
  EXPECT_EQ(this->surface()->GetProperty()->GetOpacity(), 1.0);
}

TEST_F(WeightWindow, TheOtherMethodIsSolvedBesideTheWindow)
{
  this->open(ball_with_named_weights());
  EXPECT_FALSE(this->button("Compare")->isEnabled());
  EXPECT_TRUE(this->button("Compare")->toolTip().contains("handles"));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  ASSERT_TRUE(this->window.is_bound());
  EXPECT_FALSE(this->button("Difference")->isEnabled());
  EXPECT_TRUE(this->button("Compare")->isEnabled());
  this->choose("top");
  this->choose("Harmonic");
  this->button("Compare")->click();
  EXPECT_TRUE(this->weights()->is_busy());
  EXPECT_FALSE(this->button("Compare")->isEnabled());
  this->wait_while([this] { return this->weights()->is_busy(); });
  EXPECT_EQ(this->window.error(), QString());
  EXPECT_TRUE(this->button("Difference")->isChecked());
  // Compute the same weights with the kernels.
  const TriangleMesh mesh = test::sphere(4);
  Handles handles;
  ASSERT_TRUE(to_handles(two_points(), handles).ok());
  SurfaceWeights other;
  ExecutionContext context;
  SurfaceWeightsOptions options;
  HandleElements handle_elements;
  handle_elements.points.resize(2, 3);
  handle_elements.points << 0, 0, -0.9, 0, 0, 0.9;
  options.handle_elements = handle_elements;
  ASSERT_TRUE(surface_weights(
    context, mesh.points, mesh.triangles, {}, handles, options, {},
    [](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& weights)
    { return harmonic_weights(method_context, problem, {}, weights); },
    other)
                .usable());
  double largest = 0.0;
  double squares = 0.0;
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const double difference = top_weight(mesh.points.row(v)) - other.weights(v, 1);
    largest = std::max(largest, std::abs(difference));
    squares += difference * difference / static_cast<double>(mesh.points.rows());
  }
  EXPECT_GT(largest, 0.05) << "harmonic weights are not linear";
  const Report& numbers = this->view()->numbers();
  EXPECT_NEAR(numbers.number("picture.difference.largest", 0.0), largest, 1e-6);
  EXPECT_NEAR(numbers.number("picture.difference.rms", 0.0), std::sqrt(squares), 1e-6);
  EXPECT_TRUE(this->has_label_with(QString("largest %1").arg(largest, 0, 'g', 2)));
  // After another column is chosen, the difference between the methods is shown for this column.
  // The slice is disabled.
  this->choose("bottom");
  EXPECT_TRUE(this->view()->is_shown());
  EXPECT_FALSE(this->find<QCheckBox>("Slice through the volume")->isEnabled());
  this->button("Weights")->click();
  EXPECT_EQ(this->view()->numbers().find("picture.difference.rms"), nullptr);
  // If a comparison is canceled, the result of the previous one stays.
  this->choose("Monotone");
  this->button("Compare again")->click();
  this->button("Cancel")->click();
  this->wait_while([this] { return this->weights()->is_busy(); });
  EXPECT_TRUE(this->has_label_with("the last comparison is kept"));
  EXPECT_TRUE(this->button("Difference")->isEnabled());
  // Opening another mesh ends the comparison.
  this->button("Compare again")->click();
  ASSERT_TRUE(this->window.set_mesh(box_with_named_weights(), "box"));
  this->wait_while([this] { return this->weights()->is_busy(); });
  EXPECT_FALSE(this->button("Difference")->isEnabled());
}

/// The optimality certificate is shown below the name of its method. A method cannot be compared
/// with itself.
TEST_F(WeightWindow, CertificatesNameTheirMethod)
{
  const auto mesh = ball_with_named_weights();
  vtkNew<vtkDoubleArray> certificate;
  certificate->SetName("WeightsRelativeGap");
  certificate->InsertNextValue(1e-8);
  certificate->InsertNextValue(2e-8);
  mesh->GetFieldData()->AddArray(certificate);
  vtkNew<vtkDoubleArray> residual;
  residual->DeepCopy(certificate);
  residual->SetName("WeightsKKTResidual");
  mesh->GetFieldData()->AddArray(residual);
  Report report;
  report.set("method", "bounded-biharmonic");
  attach_report(mesh, report);
  this->open(mesh);
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  ASSERT_TRUE(this->window.is_bound());
  EXPECT_TRUE(this->has_label_with("Bounded biharmonic weights:"));
  // The panel Pose, which contains the choice of the method for the next bind, also shows the
  // certificate.
  const auto note = [this](const QString& words)
  {
    const auto labels = this->part<app::handles::SidePanel>()->findChildren<QLabel*>();
    return std::any_of(
      labels.begin(), labels.end(), [&](const QLabel* label) { return label->text() == words; });
  };
  auto* chosen = this->part<app::handles::SidePanel>()->findChild<QComboBox*>("bind.method");
  EXPECT_TRUE(note("Weights: bounded biharmonic. Optimal to within 2.0e-08."));
  chosen->setCurrentIndex(1);
  EXPECT_TRUE(
    note("Weights: bounded biharmonic. Optimal to within 2.0e-08. Bind again for monotone."));
  chosen->setCurrentIndex(0);
  EXPECT_TRUE(note("Weights: bounded biharmonic. Optimal to within 2.0e-08."));
  // By default, the compared method differs from the method of the weights, so a comparison is
  // possible. A comparison of a method with itself is disabled.
  auto* other = this->panel()->findChild<QComboBox*>("weights.compare_with");
  EXPECT_TRUE(this->button("Compare")->isEnabled());
  other->setCurrentIndex(0);
  EXPECT_FALSE(this->button("Compare")->isEnabled());
  EXPECT_TRUE(this->button("Compare")->toolTip().contains("already come from this method"));
  EXPECT_FALSE(other->model()->flags(other->model()->index(0, 0)) & Qt::ItemIsEnabled);
  EXPECT_TRUE(other->model()->flags(other->model()->index(1, 0)) & Qt::ItemIsEnabled);
  // Weights without a report may come from any method.
  this->open(ball_with_named_weights());
  EXPECT_TRUE(other->model()->flags(other->model()->index(0, 0)) & Qt::ItemIsEnabled);
}

TEST_F(WeightWindow, ABindGivesVolumeRawColumnsAndCertificates)
{
  const TriangleMesh mesh = test::sphere(3);
  this->open(to_polydata(mesh.points, mesh.triangles));
  EXPECT_TRUE(this->has_label_with("There are no weights yet."));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  this->part<app::weights::Binding>()->start();
  this->wait_while([this] { return this->part<app::weights::Binding>()->is_running(); });
  ASSERT_TRUE(this->window.is_bound()) << this->window.error().toStdString();
  this->choose("top");
  vtkFieldData* certificate = this->window.shown()->GetFieldData();
  ASSERT_NE(certificate->GetArray("WeightsRelativeGap"), nullptr);
  const double gap = certificate->GetArray("WeightsRelativeGap")->GetComponent(1, 0);
  EXPECT_LE(gap, 1e-6);
  EXPECT_TRUE(this->has_label_with(QString("Gap %1, residual").arg(gap, 0, 'g', 2)));
  EXPECT_TRUE(this->button("Row sums")->isEnabled());
  this->find<QCheckBox>("Slice through the volume")->setChecked(true);
  EXPECT_TRUE(this->view()->is_sliced());
  EXPECT_GT(this->view()->slice()->GetNumberOfCells(), 20);
  // The slice shows weights of the interior. They are within the range of the column.
  vtkDataArray* values = this->view()->slice()->GetPointData()->GetArray("bindpose.Color");
  for (vtkIdType v = 0; v < values->GetNumberOfTuples(); ++v)
  {
    EXPECT_GE(values->GetComponent(v, 0), -1e-9);
    EXPECT_LE(values->GetComponent(v, 0), 1.0 + 1e-9);
  }
  // A new bind does not change the choices in the panel.
  this->part<app::weights::Binding>()->start();
  this->wait_while([this] { return this->part<app::weights::Binding>()->is_running(); });
  EXPECT_TRUE(this->view()->is_sliced());
  EXPECT_EQ(this->list("top")->currentText(), QString("top"));
  // After the mesh is saved and opened, everything except the tets is restored.
  const std::string path = testing::TempDir() + "bindpose_weights.vtp";
  ASSERT_TRUE(write_shape(this->window.shown(), path).ok());
  EXPECT_TRUE(this->window.open(QString::fromStdString(path)));
  std::remove(path.c_str());
  EXPECT_TRUE(this->has_label_with(QString("Gap %1, residual").arg(gap, 0, 'g', 2)));
  EXPECT_TRUE(this->button("Row sums")->isEnabled());
  EXPECT_TRUE(this->view()->is_shown());
  EXPECT_FALSE(this->view()->is_sliced());
  EXPECT_FALSE(this->find<QCheckBox>("Slice through the volume")->isEnabled());
}

TEST_F(WeightWindow, IsolinesAndSlicesKnowThePose)
{
  this->open(box_with_named_weights());
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  ASSERT_TRUE(this->window.is_bound());
  this->choose("top");
  const auto maximum_z = [](vtkPolyData* data)
  {
    double bounds[6];
    data->GetBounds(bounds);
    return bounds[5];
  };
  EXPECT_NEAR(maximum_z(this->view()->isolines()), 0.8, 1e-5);
  // The whole shape moves up by one.
  vtkDataArray* transforms =
    this->part<app::view::Viewport>()->handle_widget()->GetHandles()->GetCellData()->GetArray(
      "Transform");
  for (int handle : { 0, 1 })
  {
    transforms->SetComponent(handle, 11, 1.0);
  }
  transforms->Modified();
  this->window.set_method(0);
  EXPECT_NEAR(maximum_z(this->view()->isolines()), 1.8, 1e-5);
  EXPECT_NEAR(maximum_z(this->part<app::view::Viewport>()->drawn()), 2.0, 1e-5);
  // While the slice is shown, the shape is at rest.
  this->find<QCheckBox>("Slice through the volume")->setChecked(true);
  auto* handles = this->part<app::view::Viewport>()->handle_widget()->GetHandleSetRepresentation();
  EXPECT_NEAR(maximum_z(this->part<app::view::Viewport>()->drawn()), 1.0, 1e-5);
  EXPECT_NEAR(handles->GetBounds()[5], 0.9, 1e-5);
  EXPECT_EQ(this->part<app::view::Viewport>()->state_name(),
    "Rest shape: required to show the slice of weights");
  this->find<QCheckBox>("Slice through the volume")->setChecked(false);
  EXPECT_NEAR(maximum_z(this->part<app::view::Viewport>()->drawn()), 2.0, 1e-5);
  EXPECT_NEAR(handles->GetBounds()[5], 1.9, 1e-5);
  EXPECT_EQ(this->part<app::view::Viewport>()->state_name(), QString());
}

TEST_F(WeightWindow, WhatCannotBeChosenSaysWhy)
{
  const TriangleMesh mesh = test::sphere(2);
  const auto check = [this]
  {
    int disabled = 0;
    for (QWidget* widget : this->panel()->findChildren<QWidget*>())
    {
      const bool control = qobject_cast<QAbstractButton*>(widget) ||
        qobject_cast<QComboBox*>(widget) || qobject_cast<app::parts::ValueRow*>(widget);
      if (control)
      {
        EXPECT_FALSE(widget->toolTip().isEmpty()) << widget->metaObject()->className();
        disabled += !widget->isEnabled();
        if (!widget->isEnabled())
        {
          EXPECT_NE(widget->toolTip(), widget->property("tip").toString());
        }
      }
    }
    return disabled;
  };
  this->open(to_polydata(mesh.points, mesh.triangles));
  EXPECT_GT(check(), 12);
  EXPECT_TRUE(this->find<QCheckBox>("Isolines")->toolTip().contains("no weights"));
  EXPECT_FALSE(this->view()->is_shown());
  this->open(ball_with_named_weights());
  EXPECT_GT(check(), 5);
  EXPECT_TRUE(this->has_label_with("The accuracy of these weights is unknown."));
  const QCheckBox* slice = this->find<QCheckBox>("Slice through the volume");
  EXPECT_TRUE(slice->toolTip().contains(".vtu"));
  this->open(box_with_named_weights());
  check();
  EXPECT_TRUE(slice->isEnabled());
}

TEST_F(WeightWindow, NoTextOfTheWeightPanelIsClipped)
{
  auto grid = box_with_named_weights();
  add_array(grid, "RawWeights", { bottom_weight, top_weight });
  grid->GetPointData()->GetArray("Weights")->SetComponentName(
    0, "a handle whose name somebody has made much too long for any list");
  this->open(grid);
  this->find<QCheckBox>("Extrema away from handles")->setChecked(true);
  this->panel()->set_comparison(
    "Difference from Linear subspace (12.3 s): largest 0.00012, rms 1.2e-05");
  this->panel()->set_certificate(
    "Bounded biharmonic weights:\nWorst gap 1.2e-07, residual 1.2e-07\n123 iterations, all handles "
    "12.34 s");
  for (const QSize& size : { QSize(900, 680), QSize(1280, 800), QSize(1920, 1080) })
  {
    this->resize(size);
    test::expect_unclipped_buttons(this->part<app::window::PanelColumn>());
    for (QCheckBox* check : this->panel()->findChildren<QCheckBox*>())
    {
      EXPECT_LE(check->sizeHint().width(), check->width()) << check->text().toStdString();
      EXPECT_LE(check->sizeHint().height(), check->height()) << check->text().toStdString();
    }
    test::expect_unclipped_items(this->panel());
    for (QLabel* label : this->panel()->findChildren<QLabel*>())
    {
      if (!label->isVisible())
      {
        continue; // some labels are shown for textured surfaces only
      }
      EXPECT_LE(label->heightForWidth(label->width()), label->height())
        << label->text().toStdString();
      if (!label->wordWrap())
      {
        EXPECT_LE(label->sizeHint().width(), label->width()) << label->text().toStdString();
        EXPECT_LE(label->sizeHint().height(), label->height()) << label->text().toStdString();
      }
    }
  }
}
