#include "app/tour/tour_player.h"

#include "app/tour/tour_values.h"
#include "app/view/viewport.h"
#include "app/weights/binding.h"
#include "app/window/main_window.h"
#include "widgets/gizmo.h"

#include "io/atomic_file.h"

#include "vtkImageData.h"
#include "vtkRenderWindow.h"

#include <QAbstractButton>
#include <QApplication>
#include <QDialog>
#include <QDir>
#include <QEventLoop>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QMessageBox>
#include <QPointer>
#include <QTimer>

#include <algorithm>

namespace app::tour
{

using namespace bindpose;

namespace
{
using Json = nlohmann::ordered_json;

// frames per second that are recorded while the shape moves without user input
constexpr double film_rate = 20.0;
// A pixel belongs to the background if no color component differs by more than this value from the
// background color of its row. Components are from 0 to 255. Within a row, the background color
// varies by less than this value.
constexpr int background_tolerance = 12;

Qt::MouseButton button_of(const TourStep& step)
{
  return step.button == TourButton::left ? Qt::LeftButton
    : step.button == TourButton::middle  ? Qt::MiddleButton
                                         : Qt::RightButton;
}

Qt::KeyboardModifiers modifiers_of(const TourStep& step)
{
  Qt::KeyboardModifiers modifiers;
  modifiers.setFlag(Qt::ShiftModifier, step.shift);
  modifiers.setFlag(Qt::ControlModifier, step.ctrl);
  modifiers.setFlag(Qt::AltModifier, step.alt);
  return modifiers;
}

/// Convert an image to a QImage, with alpha if the image has alpha.
QImage to_image(vtkImageData* picture)
{
  const int* size = picture->GetDimensions();
  const int components = picture->GetNumberOfScalarComponents();
  return QImage(static_cast<const uchar*>(picture->GetScalarPointer()), size[0], size[1],
    components * size[0], components == 4 ? QImage::Format_RGBA8888 : QImage::Format_RGB888)
    .mirrored();
}

/// Return the image scaled down to this width if it is wider; 0: no limit.
QImage at_most(const QImage& picture, int width)
{
  return width > 0 && width < picture.width()
    ? picture.scaledToWidth(width, Qt::SmoothTransformation)
    : picture;
}

/// Return the fraction of pixels that differ from the background. The last pixel of each row
/// determines the background color of the row.
double drawn_fraction(const QImage& picture)
{
  long long drawn = 0;
  for (int y = 0; y < picture.height(); ++y)
  {
    const QRgb back = picture.pixel(picture.width() - 1, y);
    for (int x = 0; x < picture.width(); ++x)
    {
      const QRgb color = picture.pixel(x, y);
      drawn +=
        std::max({ std::abs(qRed(color) - qRed(back)), std::abs(qGreen(color) - qGreen(back)),
          std::abs(qBlue(color) - qBlue(back)) }) > background_tolerance;
    }
  }
  const double all = static_cast<double>(picture.width()) * picture.height();
  return all > 0.0 ? static_cast<double>(drawn) / all : 0.0;
}

QString json_text(const Json& value)
{
  return QString::fromStdString(value.dump());
}

/// Discards events of the real mouse and keyboard, because the real mouse may be over the window.
/// Qt reports such events as spontaneous.
class RealInputFilter : public QObject
{
public:
  bool eventFilter(QObject* /*object*/, QEvent* event) override
  {
    switch (event->type())
    {
      case QEvent::MouseButtonPress:
      case QEvent::MouseButtonRelease:
      case QEvent::MouseButtonDblClick:
      case QEvent::MouseMove:
      case QEvent::Wheel:
      case QEvent::Enter:
      case QEvent::Leave:
      case QEvent::KeyPress:
      case QEvent::KeyRelease:
        return event->spontaneous();
      default:
        return false;
    }
  }
};

void wait_seconds(double seconds)
{
  QEventLoop loop; // a nested event loop, which sleeps between events
  QTimer::singleShot(static_cast<int>(1e3 * seconds), Qt::PreciseTimer, &loop, &QEventLoop::quit);
  loop.exec();
}
} // namespace

TourPlayer::TourPlayer(window::MainWindow* window, const Tour& tour, const std::string& folder)
  : window_(window), tour_(tour), tour_folder_(folder), user_(window),
    real_input_filter_(std::make_unique<RealInputFilter>())
{
  QApplication::instance()->installEventFilter(this->real_input_filter_.get());
  QObject::connect(window->findChild<view::Viewport*>(), &QOpenGLWidget::frameSwapped,
    &this->context_,
    [this]
    {
      if (this->first_picture_ < 0.0 && !this->window_->is_empty())
      {
        this->first_picture_ = seconds_since_start();
        this->first_picture_cpu_ = thread_cpu_seconds();
      }
    });
}

Status TourPlayer::play(const TourRequest& request)
{
  this->folder_ = request.folder;
  this->overwrite_ = request.overwrite;
  this->time_limit_ = request.seconds > 0.0 ? request.seconds : this->tour_.seconds;
  this->record_ = { { "tour", { { "schema", 1 }, { "name", this->tour_.name } } },
    { "steps", Json::array() }, { "screenshots", Json::object() } };
  Status status;
  if (!this->folder_.empty())
  {
    if (!QDir().mkpath(QString::fromStdString(this->folder_)))
    {
      return Status::invalid_input("folder '" + this->folder_ + "' cannot be created");
    }
    for (const TourStep& step : this->tour_.steps)
    {
      AtomicFile file; // check before the tour that the file can be written
      const std::string name = step.verb == TourVerb::screenshot ? step.text + ".png"
        : step.answer.empty()                                    ? "tour.json"
                                                                 : step.answer;
      status = file.open(this->folder_ + "/" + name, this->overwrite_);
      if (!status.ok())
      {
        return status;
      }
    }
  }
  this->clock_.start();
  // under Xvfb there is no window manager that activates the window
  QApplication::setActiveWindow(this->window_);
  this->process_drawing();
  this->fit_view();
  for (std::size_t k = 0; k < this->tour_.steps.size() && status.ok(); ++k)
  {
    const TourStep& step = this->tour_.steps[k];
    const double begin = 1e-9 * static_cast<double>(this->clock_.nsecsElapsed());
    const double cpu_begin = cpu_seconds();
    QString message = this->answer_dialogs([&] { return this->perform(step); }, step.answer);
    this->process_drawing();
    if (message.isEmpty())
    {
      message = this->fit_view();
    }
    const double seconds = 1e-9 * static_cast<double>(this->clock_.nsecsElapsed()) - begin;
    const double cpu = cpu_seconds() - cpu_begin;
    if (message.isEmpty() && this->left() <= 0.0)
    {
      message = this->timeout_message();
    }
    if (step.verb != TourVerb::check)
    {
      this->last_seconds_ = seconds;
      this->last_cpu_seconds_ = cpu;
    }
    this->record_["steps"].push_back({ { "step", k + 1 }, { "verb", to_string(step.verb) },
      { "about", step.text }, { "seconds", seconds }, { "cpu_seconds", cpu } });
    if (!message.isEmpty())
    {
      const std::string about = step.text.empty() ? "" : " '" + step.text + "'";
      status =
        Status::invalid_input("tour '" + this->tour_.name + "', step " + std::to_string(k + 1) +
          " (" + to_string(step.verb) + about + "): " + message.toStdString());
    }
  }
  this->record_["passed"] = status.ok();
  this->record_["message"] = status.message;
  this->record_["seconds"] = 1e-3 * static_cast<double>(this->clock_.elapsed());
  if (this->first_picture_ >= 0.0)
  {
    this->record_["first_picture_seconds"] = this->first_picture_;
    // CPU time of the window's thread, which does not depend on other load of the machine.
    this->record_["first_picture_cpu_seconds"] = this->first_picture_cpu_;
  }
  const Status written = this->write_record(request);
  return status.ok() ? written : status;
}

Status TourPlayer::write_record(const TourRequest& request) const
{
  if (request.folder.empty())
  {
    return {};
  }
  // Replace invalid UTF-8, because names may contain arbitrary bytes.
  return write_file_atomically(request.folder + "/tour.json",
    this->record_.dump(2, ' ', false, Json::error_handler_t::replace) + '\n', request.overwrite);
}

double TourPlayer::left() const
{
  return this->time_limit_ - 1e-3 * static_cast<double>(this->clock_.elapsed());
}

QString TourPlayer::timeout_message() const
{
  return QString("the tour exceeded its time limit of %1 s").arg(this->time_limit_);
}

/// Let the window process all requests to draw, without waiting for other work.
void TourPlayer::process_drawing()
{
  // Three rounds of events are needed: for a change, for the rendering that the change requests,
  // and for the buffer swap.
  for (int round = 0; round < 3; ++round)
  {
    QApplication::processEvents();
  }
}

/// Run `perform_step` and answer the modal dialogs that it opens. If `answer` is empty, all dialogs
/// are closed. Otherwise `answer` is entered as the file name in a file dialog, every dialog except
/// a message box is accepted once, and dialogs that remain open are closed. If a dialog was closed,
/// return a sentence about it.
QString TourPlayer::answer_dialogs(
  const std::function<QString()>& perform_step, const std::string& answer)
{
  const QString file =
    QDir(QString::fromStdString(this->folder_)).absoluteFilePath(QString::fromStdString(answer));
  if (!answer.empty() && this->folder_.empty())
  {
    return QString("an answer that names a file requires --screenshot-dir");
  }
  QString title;
  bool answered = false;
  QPointer<QDialog> accepted;
  QTimer dialog_timer; // this timer also fires while a modal dialog is open
  QObject::connect(&dialog_timer, &QTimer::timeout, &dialog_timer,
    [&]
    {
      QWidget* dialog = QApplication::activeModalWidget();
      auto* form = qobject_cast<QDialog*>(dialog);
      if (form && form != accepted && !answer.empty() && !qobject_cast<QMessageBox*>(form))
      {
        if (auto* files = qobject_cast<QFileDialog*>(form))
        {
          // No confirmation is necessary, because play() has already checked the file.
          files->setOption(QFileDialog::DontConfirmOverwrite);
          auto* name = files->findChild<QLineEdit*>();
          // do not use selectFile(), because it does not change a field with the keyboard focus
          name->setText(file);
          answered = true;
        }
        accepted = form;
        // Queue the call of accept(), because accept() may open another dialog and wait for the
        // answer. The timer cannot answer that dialog before this function has returned.
        QMetaObject::invokeMethod(form, "accept", Qt::QueuedConnection);
      }
      else if (dialog)
      {
        title = dialog->windowTitle();
        title = title.isEmpty() ? QString("without a title") : QString("'%1'").arg(title);
        dialog->close();
      }
    });
  dialog_timer.start(50);
  const QString message = perform_step();
  if (!answer.empty() && !answered && message.isEmpty())
  {
    return QString("expected a file dialog, but none was opened");
  }
  return title.isEmpty()
    ? message
    : QString("the step opened the dialog %1, which needs an answer").arg(title);
}

QString TourPlayer::perform(const TourStep& step)
{
  const QString word = QString::fromStdString(step.text);
  switch (step.verb)
  {
    case TourVerb::open:
      return this->open(step.text);
    case TourVerb::action:
      return this->user_.trigger(word);
    case TourVerb::push:
      return this->user_.push_button(word);
    case TourVerb::option:
      return this->choose(step);
    case TourVerb::panel:
      return this->user_.show_panel(word);
    case TourVerb::select:
      return this->user_.select(word);
    case TourVerb::scrub:
      this->user_.scrub(step.seconds);
      return {};
    case TourVerb::type:
      return this->user_.type(word, QString::fromStdString(step.field));
    case TourVerb::mode:
      return this->user_.set_mode(word);
    case TourVerb::key:
      return this->user_.press_key(word);
    case TourVerb::resize:
      this->window_->resize(step.size[0], step.size[1]);
      this->process_drawing();
      return this->window_->width() == step.size[0] && this->window_->height() == step.size[1]
        ? QString()
        : QString("cannot resize the window: its size is %1 x %2")
            .arg(this->window_->width())
            .arg(this->window_->height());
    case TourVerb::wait:
      return this->wait(step);
    case TourVerb::film:
      this->film_ = step.text == "end" ? TourStep() : step;
      this->frames_ = 0;
      return {};
    case TourVerb::screenshot:
      return this->screenshot(step);
    case TourVerb::check:
      return this->check(step);
    default:
      return this->use_mouse(step);
  }
}

// ---- User actions ------------------------------------------------------------------------------

QString TourPlayer::open(const std::string& file)
{
  const QString name = QString::fromStdString(file);
  const QString path_beside_tour = QDir(QString::fromStdString(this->tour_folder_)).filePath(name);
  const QString before = this->window_->error();
  const QString message =
    this->user_.drop(QFileInfo::exists(path_beside_tour) ? path_beside_tour : name);
  const QString error = this->window_->error();
  return message.isEmpty() || error.isEmpty() || error == before ? message : error;
}

QString TourPlayer::choose(const TourStep& step)
{
  const QString key = QString::fromStdString(step.text);
  if (step.expects_text)
  {
    return this->user_.choose(key, QString::fromStdString(step.expected_text));
  }
  if (step.expected.size() != 1)
  {
    return QString("the value of an option must be a word, a number, true or false");
  }
  return this->user_.choose(
    key, step.expects_bool ? QVariant(step.expected[0] != 0.0) : QVariant(step.expected[0]));
}

QString TourPlayer::find(const TourPosition& mouse_position, QPoint& position) const
{
  const bool is_gizmo_part = mouse_position.gizmo_part != no_part;
  if (mouse_position.handle.empty() && !is_gizmo_part)
  {
    position =
      this->user_.pixel_of_fractions(mouse_position.position[0], mouse_position.position[1]);
    return {};
  }
  const QString message = is_gizmo_part
    ? this->user_.find_gizmo_position(mouse_position.gizmo_part, position)
    : this->user_.find_handle_position(
        QString::fromStdString(mouse_position.handle), mouse_position.bone_fraction, position);
  position += QPoint(
    static_cast<int>(mouse_position.position[0]), static_cast<int>(mouse_position.position[1]));
  return message;
}

QString TourPlayer::use_mouse(const TourStep& step)
{
  const Qt::MouseButton button = button_of(step);
  const Qt::KeyboardModifiers modifiers = modifiers_of(step);
  QPoint position, to;
  QString message = this->find(step.mouse_position, position);
  if (message.isEmpty() && step.verb == TourVerb::drag)
  {
    message = this->find(step.to, to);
  }
  if (!message.isEmpty())
  {
    return message;
  }
  const auto move = [&](const QPoint& target)
  {
    this->user_.move(target, modifiers);
    this->process_drawing();
    return this->film_frame();
  };
  switch (step.verb)
  {
    case TourVerb::press:
      // move the mouse there first, because a user's press follows a move
      this->user_.move(position, modifiers);
      this->user_.press(position, button, modifiers);
      return {};
    case TourVerb::move:
      return move(position);
    case TourVerb::release:
      this->user_.release(position, button, modifiers);
      return {};
    case TourVerb::click:
      this->user_.move(position, modifiers);
      this->user_.press(position, button, modifiers);
      this->process_drawing();
      this->user_.release(position, button, modifiers);
      return {};
    case TourVerb::double_click:
      this->user_.move(position, modifiers);
      this->user_.double_click(position, button, modifiers);
      return {};
    case TourVerb::wheel:
      this->user_.wheel(position, step.turns, modifiers);
      return this->film_frame();
    default:
      this->user_.move(position, modifiers);
      this->process_drawing();
      this->user_.press(position, button, modifiers);
      for (int k = 1; k <= step.moves && message.isEmpty(); ++k)
      {
        message = move(position + (to - position) * k / step.moves);
      }
      this->user_.release(to, button, modifiers);
      return message;
  }
}

QString TourPlayer::wait(const TourStep& step)
{
  if (step.text == "bind")
  {
    return wait_until([this]
             { return !this->window_->findChild<weights::Binding*>()->is_running(); },
             this->left())
      ? QString()
      : QString("the bind did not end within the time limit");
  }
  if (step.text == "idle")
  {
    return wait_until([this] { return is_idle(this->window_); }, this->left())
      ? QString()
      : QString("the window was still busy at the time limit of the tour");
  }
  // The timeout of the tour may shorten a wait. Report the timeout here: play() might not detect
  // it, because timers may end a millisecond too early.
  const double left = std::max(0.0, this->left());
  const double seconds = std::min(step.seconds, left);
  const QString message = step.seconds > left ? this->timeout_message() : QString();
  if (this->film_.text.empty())
  {
    wait_seconds(seconds);
    return message;
  }
  QElapsedTimer clock;
  clock.start();
  for (int frame = 1; frame <= seconds * film_rate; ++frame)
  {
    const double wait_time = frame / film_rate - 1e-3 * static_cast<double>(clock.elapsed());
    wait_seconds(std::max(0.0, wait_time));
    const QString failed = this->film_frame();
    if (!failed.isEmpty())
    {
      return failed;
    }
  }
  return message;
}

// ---- Values and images -----------------------------------------------------------------------

Json TourPlayer::values() const
{
  Json values = tour_values(this->window_);
  values["step.seconds"] = this->last_seconds_;
  values["step.cpu_share"] =
    this->last_seconds_ > 0.0 ? this->last_cpu_seconds_ / this->last_seconds_ : 0.0;
  if (this->first_picture_ >= 0.0)
  {
    values["first_picture.seconds"] = this->first_picture_;
  }
  return values;
}

QString TourPlayer::check(const TourStep& step)
{
  const Json values = this->values();
  const auto found = values.find(step.text);
  if (found == values.end())
  {
    return QString("there is no value with this name at this step");
  }
  Json expected = step.expects_bool ? Json(step.expected[0] != 0.0)
    : step.expects_text             ? Json(step.expected_text)
    : step.expected.size() == 1     ? Json(step.expected[0])
                                    : Json(step.expected);
  QString reference_text;
  if (step.relation == TourRelation::as_at)
  {
    const Json& earlier_values = this->record_["screenshots"][step.expected_text]["values"];
    if (!earlier_values.contains(step.text))
    {
      return QString("there was no value with this name at the screenshot '%1'")
        .arg(QString::fromStdString(step.expected_text));
    }
    expected = earlier_values[step.text];
    reference_text = QString(" as it was when the screenshot '%1' was taken")
                       .arg(QString::fromStdString(step.expected_text));
  }
  if (step.relation == TourRelation::at_least || step.relation == TourRelation::at_most)
  {
    const bool least = step.relation == TourRelation::at_least;
    const double limit = step.expected[0];
    const double value = found->is_number() ? found->get<double>() : std::nan("");
    const bool is_satisfied = least ? value >= limit : value <= limit;
    return is_satisfied ? QString()
                        : QString("the value is %1, expected at %2 %3")
                            .arg(json_text(*found), least ? "least" : "most")
                            .arg(limit);
  }
  if (distance(*found, expected) <= step.tolerance)
  {
    return {};
  }
  const QString tolerance_text =
    step.tolerance > 0.0 ? QString(" within %1").arg(step.tolerance) : QString();
  return QString("the value is %1, expected %2%4%3")
    .arg(json_text(*found), json_text(expected), reference_text, tolerance_text);
}

QImage TourPlayer::grab(TourPart part, int width)
{
  QWidget* dialog = nullptr;
  for (auto* candidate : this->window_->findChildren<QDialog*>())
  {
    dialog = candidate->isVisible() ? candidate : dialog;
  }
  this->process_drawing();
  view::Viewport* viewport = this->user_.viewport();
  viewport->renderWindow()->Render();
  QApplication::processEvents();
  const QImage picture = part == TourPart::view ? viewport->grabFramebuffer()
    : part == TourPart::window                  ? this->window_->grab().toImage()
    : dialog                                    ? dialog->grab().toImage()
                                                : QImage();
  return at_most(picture.convertToFormat(QImage::Format_RGB32), width);
}

QString TourPlayer::write(const QImage& picture, const std::string& name)
{
  if (this->folder_.empty())
  {
    return {};
  }
  AtomicFile file;
  Status status = file.open(this->folder_ + "/" + name, this->overwrite_);
  if (status.ok())
  {
    status = picture.save(QString::fromStdString(file.temporary()), "PNG")
      ? file.commit()
      : Status::invalid_input("'" + name + "' cannot be written");
  }
  return QString::fromStdString(status.message);
}

/// Resize the window until the 3D view has the tour's size. Several attempts are needed, because
/// the sizes of other widgets depend on the fonts, and some widgets appear and disappear.
QString TourPlayer::fit_view()
{
  const QSize expected(this->tour_.view[0], this->tour_.view[1]);
  if (expected.width() == 0)
  {
    return {};
  }
  const auto missing = [&] { return expected - this->user_.viewport()->size(); };
  for (int tries = 0; tries < 3 && missing() != QSize(0, 0); ++tries)
  {
    this->window_->resize(this->window_->size() + missing());
    this->process_drawing();
  }
  const QSize view_size = this->user_.viewport()->size();
  return view_size == expected ? QString()
                               : QString("cannot resize the view: its size is %1 x %2")
                                   .arg(view_size.width())
                                   .arg(view_size.height());
}

QString TourPlayer::screenshot(const TourStep& step)
{
  QImage picture;
  if (step.scale == 1 && !step.transparent)
  {
    picture = this->grab(step.part, step.width);
  }
  else
  {
    vtkSmartPointer<vtkImageData> image;
    const Status status = this->user_.viewport()->take_picture(step.scale, step.transparent, image);
    if (!status.ok())
    {
      return QString::fromStdString(status.message);
    }
    picture = at_most(to_image(image), step.width);
  }
  const double drawn = drawn_fraction(this->user_.viewport()->grabFramebuffer());
  if (picture.isNull() || (drawn == 0.0 && !this->window_->is_empty()))
  {
    return QString("the picture is empty");
  }
  this->record_["screenshots"][step.text] = { { "file", step.text + ".png" },
    { "width", picture.width() }, { "height", picture.height() }, { "drawn_share", drawn },
    { "values", this->values() } };
  return this->write(picture, step.text + ".png");
}

QString TourPlayer::film_frame()
{
  if (this->film_.text.empty() || this->folder_.empty())
  {
    return {};
  }
  const QString number = QString("%1").arg(this->frames_++, 4, 10, QChar('0'));
  this->record_["films"][this->film_.text] = this->frames_;
  return this->write(this->grab(this->film_.part, this->film_.width),
    this->film_.text + "_" + number.toStdString() + ".png");
}

} // namespace app::tour
