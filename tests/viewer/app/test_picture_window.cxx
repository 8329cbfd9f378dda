// Saved pictures of the view: they have the requested size and show the same as the window. A
// picture with a transparent background, composited over any color, equals a picture drawn on this
// color.
#include "unclipped.h"
#include "window_test.h"

#include "app/window/exports.h"
#include "app/window/picture_dialog.h"

#include "document/document.h"
#include "document/user_settings.h"
#include "pictures/window_picture.h"

#include "support/files.h"
#include "support/meshes.h"

#include "vtkCamera.h"
#include "vtkImageData.h"

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QSettings>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace bindpose;

namespace
{
QColor pixel_of(vtkImageData* picture, int x, int y)
{
  const auto* p = static_cast<const unsigned char*>(
    picture->GetScalarPointer(x, picture->GetDimensions()[1] - 1 - y, 0));
  return { p[0], p[1], p[2], picture->GetNumberOfScalarComponents() == 4 ? p[3] : 255 };
}

QImage image_of(vtkImageData* picture)
{
  QImage image(picture->GetDimensions()[0], picture->GetDimensions()[1], QImage::Format_ARGB32);
  for (int y = 0; y < image.height(); ++y)
  {
    for (int x = 0; x < image.width(); ++x)
    {
      image.setPixelColor(x, y, pixel_of(picture, x, y));
    }
  }
  return image;
}

int distance(const QColor& a, const QColor& b)
{
  return std::max({ std::abs(a.red() - b.red()), std::abs(a.green() - b.green()),
    std::abs(a.blue() - b.blue()) });
}

double differing_fraction(const QImage& a, const QImage& b, int level)
{
  EXPECT_EQ(a.size(), b.size());
  int differing_pixels = 0;
  for (int y = 0; y < a.height(); ++y)
  {
    for (int x = 0; x < a.width(); ++x)
    {
      differing_pixels += distance(a.pixelColor(x, y), b.pixelColor(x, y)) > level;
    }
  }
  return static_cast<double>(differing_pixels) / (a.width() * a.height());
}

/// Return the difference in lightness between the background and the letters and lines of the
/// scalar bar, summed over all pixels. The sum is proportional to the thickness of letters and
/// lines.
double darkness_sum(const QImage& image)
{
  double sum = 0.0;
  for (int y = 0; y < image.height(); ++y)
  {
    const int background = image.pixelColor(image.width() - 1, y).lightness();
    for (int x = image.width() / 25; x < image.width() / 6; ++x)
    {
      const QColor c = image.pixelColor(x, y);
      sum += c.saturation() < 60 ? std::max(0, background - c.lightness()) : 0;
    }
  }
  return sum;
}

/// Return the color of a pixel that is composited over a ground color.
QColor composite(const QColor& pixel, const Rgb& background)
{
  const double alpha = pixel.alphaF();
  const auto mixed = [alpha](int value, double below)
  { return static_cast<int>(std::lround(alpha * value + (1.0 - alpha) * 255.0 * below)); };
  return { mixed(pixel.red(), background[0]), mixed(pixel.green(), background[1]),
    mixed(pixel.blue(), background[2]) };
}

class PictureWindow : public test::WindowTest
{
protected:
  /// Open a ball with two handles, with the isolines and the scalar bar of one handle's weights.
  void open_weighted()
  {
    const TriangleMesh ball = test::sphere(4);
    ASSERT_TRUE(this->window.set_mesh(to_polydata(ball.points, ball.triangles), "ball"));
    ASSERT_TRUE(this->window.set_handles(test::two_points(), "points"));
    Weights weights(ball.points.rows(), 2);
    weights.col(1) = 0.5 * (ball.points.col(2).array() + 1.0);
    weights.col(0) = 1.0 - weights.col(1).array();
    ASSERT_TRUE(this->window.document()->set_weights(weights, "heights").ok());
    this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::weights);
    this->resize({ 900, 700 });
  }

  vtkSmartPointer<vtkImageData> take(int scale, bool transparent)
  {
    vtkSmartPointer<vtkImageData> picture;
    const Status status =
      this->part<app::view::Viewport>()->take_picture(scale, transparent, picture);
    EXPECT_TRUE(status.ok()) << status.message;
    return picture;
  }

  /// Expect that the transparent picture, composited over plain colors, equals the opaque picture
  /// on such a background. The pictures must be equal at every pixel, including antialiased edges,
  /// translucent objects and letters.
  void expect_correct_compositing(int scale)
  {
    const auto transparent_picture = this->take(scale, true);
    ASSERT_EQ(transparent_picture->GetNumberOfScalarComponents(), 4);
    vtkRenderer* renderer = this->part<app::view::Viewport>()->renderer();
    const Rgb backgrounds[] = { { 1.0, 1.0, 1.0 }, { 0.0, 0.0, 0.0 }, { 0.8, 0.2, 0.6 } };
    int partly_covered = 0; // number of pixels that are partly covered
    for (const Rgb& background : backgrounds)
    {
      renderer->GradientBackgroundOff();
      renderer->SetBackground(background[0], background[1], background[2]);
      const auto drawn = this->take(scale, false);
      renderer->GradientBackgroundOn();
      const int* size = drawn->GetDimensions();
      int worst = 0;
      for (int y = 0; y < size[1]; ++y)
      {
        for (int x = 0; x < size[0]; ++x)
        {
          const QColor pixel = pixel_of(transparent_picture, x, y);
          partly_covered += pixel.alpha() > 30 && pixel.alpha() < 225;
          worst = std::max(worst, distance(composite(pixel, background), pixel_of(drawn, x, y)));
        }
      }
      EXPECT_LE(worst, 4) << "of 255, over " << background[0] << " " << background[1] << " "
                          << background[2];
    }
    EXPECT_GT(partly_covered, 500) << "edges are partly covered";
    // The background is fully transparent.
    EXPECT_EQ(
      pixel_of(transparent_picture, transparent_picture->GetDimensions()[0] - 4, 4).alpha(), 0);
  }
};
} // namespace

TEST_F(PictureWindow, IsSoManyTimesAsLarge)
{
  this->open_weighted();
  const int* size = this->part<app::view::Viewport>()->renderWindow()->GetSize();
  for (const int scale : { 1, 3 })
  {
    const auto picture = this->take(scale, false);
    EXPECT_EQ(picture->GetDimensions()[0], scale * size[0]);
    EXPECT_EQ(picture->GetDimensions()[1], scale * size[1]);
    EXPECT_EQ(picture->GetNumberOfScalarComponents(), 3);
    EXPECT_EQ(
      this->part<app::view::Viewport>()->picture_size(scale), scale * QSize(size[0], size[1]));
  }
}

TEST_F(PictureWindow, OfEveryScaleIsWhatIsSeenOnlyFiner)
{
  this->open_weighted();
  const QImage seen = this->picture().convertToFormat(QImage::Format_ARGB32);
  for (const int scale : { 1, 2, 5 }) // scale 5 needs several tiles
  {
    const QImage taken = image_of(this->take(scale, false));
    const QImage small = taken.scaled(seen.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    // Only the pixels at the edges of letters and lines may differ.
    EXPECT_LT(differing_fraction(small, seen, 24), 0.02) << scale;
    EXPECT_LT(differing_fraction(small, seen, 80), 0.004) << scale;
    EXPECT_NEAR(
      darkness_sum(taken) / (scale * scale), darkness_sum(seen), 0.15 * darkness_sum(seen))
      << scale;
  }
}

TEST_F(PictureWindow, LeavesTheWindowAsItWas)
{
  this->open_weighted();
  vtkCamera* camera = this->part<app::view::Viewport>()->renderer()->GetActiveCamera();
  const QImage before = this->picture();
  const Vec3 from(camera->GetPosition());
  this->take(5, true);
  EXPECT_EQ(this->part<app::view::Viewport>()->renderer()->GetActiveCamera(), camera);
  EXPECT_EQ(Vec3(camera->GetPosition()), from);
  EXPECT_EQ(this->picture(), before);
}

TEST_F(PictureWindow, HasNoFringeWhereItIsTransparent)
{
  this->open_weighted();
  this->expect_correct_compositing(1);
  this->expect_correct_compositing(2);
  const auto transparent_picture = this->take(2, true);
  const QPoint middle = 2 * this->pixel(Vec3(0, 0, 0));
  EXPECT_EQ(pixel_of(transparent_picture, middle.x(), middle.y()).alpha(), 255);
}

TEST_F(PictureWindow, KeepsSeeThroughThingsSeeThrough)
{
  this->open_weighted();
  this->part<app::view::Viewport>()->set_surface_appearance(app::view::Viewport::see_through);
  this->expect_correct_compositing(1);
  const auto transparent_picture = this->take(1, true);
  const QPoint beside = this->pixel(Vec3(0.4, 0.3, 0));
  EXPECT_GT(pixel_of(transparent_picture, beside.x(), beside.y()).alpha(), 60);
  EXPECT_LT(pixel_of(transparent_picture, beside.x(), beside.y()).alpha(), 200);
}

TEST_F(PictureWindow, IsWrittenWithItsAlpha)
{
  this->open_weighted();
  const test::Folder folder;
  const QString path = QString::fromStdString(folder / "ball.png");
  ASSERT_TRUE(this->part<app::window::Exports>()->save_picture(path, 2, true));
  const QImage read(path);
  EXPECT_TRUE(read.hasAlphaChannel());
  EXPECT_EQ(read.size(), this->part<app::view::Viewport>()->picture_size(2));
  EXPECT_EQ(qAlpha(read.pixel(read.width() - 3, 3)), 0);
  ASSERT_TRUE(this->part<app::window::Exports>()->save_picture(path, 1, false));
  EXPECT_FALSE(QImage(path).hasAlphaChannel());
  EXPECT_FALSE(
    this->part<app::window::Exports>()->save_picture("/no/such/folder/ball.png", 1, false));
  EXPECT_EQ(this->window.error().count('\n'), 0);
  EXPECT_FALSE(this->window.error().isEmpty());
}

TEST_F(PictureWindow, TheDialogTellsTheSizeAndRemembers)
{
  this->open_weighted();
  const QSize size = this->part<app::view::Viewport>()->picture_size(1);
  {
    app::window::PictureDialog dialog(this->part<app::view::Viewport>(), &this->window);
    dialog.show();
    QApplication::processEvents();
    EXPECT_EQ(dialog.scale(), 1);
    EXPECT_FALSE(dialog.is_transparent());
    auto* scale = dialog.findChild<QComboBox*>();
    ASSERT_EQ(scale->count(), 8);
    for (int factor = 1; factor <= 8; ++factor)
    {
      scale->setCurrentIndex(factor - 1);
      EXPECT_EQ(dialog.size_note(),
        QString("%L1 × %L2 pixels").arg(factor * size.width()).arg(factor * size.height()));
    }
    test::expect_unclipped_buttons(&dialog);
    test::expect_unclipped_items(&dialog);
    scale->setCurrentIndex(3);
    dialog.findChild<QCheckBox*>()->setChecked(true);
    if (const char* folder = std::getenv("BINDPOSE_PICTURES"))
    {
      QApplication::processEvents();
      EXPECT_TRUE(dialog.grab().save(QString(folder) + "/picture_dialog.png"));
    }
    dialog.reject(); // a rejected dialog stores no choice
  }
  {
    app::window::PictureDialog dialog(this->part<app::view::Viewport>(), &this->window);
    EXPECT_EQ(dialog.scale(), 1);
    dialog.findChild<QComboBox*>()->setCurrentIndex(3);
    dialog.findChild<QCheckBox*>()->setChecked(true);
    dialog.accept();
  }
  app::window::PictureDialog dialog(this->part<app::view::Viewport>(), &this->window);
  EXPECT_EQ(dialog.scale(), 4);
  EXPECT_TRUE(dialog.is_transparent());
  user_settings()->remove("picture");
}

TEST(PictureSize, WhatIsTooLargeIsOneSentence)
{
  EXPECT_TRUE(check_picture_size(32767, 8192).ok());
  EXPECT_TRUE(check_picture_size(16384, 16384).ok());
  EXPECT_EQ(check_picture_size(40000, 10).message,
    "a picture of 40000 x 10 pixels is too large: expected at most 32767 pixels in "
    "width and height and 268 million pixels in total");
  EXPECT_FALSE(check_picture_size(20000, 20000).ok());
}
