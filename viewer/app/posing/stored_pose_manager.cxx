#include "app/posing/stored_pose_manager.h"

#include "app/posing/key_strip.h"
#include "app/posing/pose_list_widget.h"

#include "poses/pose_blend.h"

#include <cmath>

namespace app::posing
{

using namespace bindpose;

namespace
{
constexpr int display_interval = 16; // milliseconds
}

StoredPoseManager::StoredPoseManager(
  PoseListWidget* list, KeyStrip* strip, std::function<Pose()> pose, QObject* parent)
  : QObject(parent), list_(list), strip_(strip), get_pose_(std::move(pose))
{
  this->connect_list();
  this->connect_strip();
  this->play_timer_.setTimerType(Qt::PreciseTimer);
  this->play_timer_.setInterval(display_interval);
  QObject::connect(&this->play_timer_, &QTimer::timeout, this, &StoredPoseManager::tick);
}

void StoredPoseManager::set_handles(const std::shared_ptr<const Handles>& handles)
{
  this->handles_ = handles;
  this->list_->set_ready(handles != nullptr);
  this->strip_->set_ready(handles != nullptr);
}

// ---- Stored poses ------------------------------------------------------------------------------

void StoredPoseManager::connect_list()
{
  PoseListWidget* list = this->list_;
  QObject::connect(list, &PoseListWidget::store_requested, this,
    [this]
    {
      this->stored_poses_.library.store(
        tr("pose").toStdString(), NamedPose(*this->handles_, this->get_pose_()));
      this->change_stored_poses(tr("store a pose"));
      this->list_->select_entry(static_cast<int>(this->stored_poses_.library.entries().size()) - 1);
    });
  QObject::connect(list, &PoseListWidget::apply_requested, this,
    [this](int entry)
    {
      const auto& stored_entry =
        this->stored_poses_.library.entries()[static_cast<std::size_t>(entry)];
      Q_EMIT this->pose_requested(stored_entry.pose.for_handles(*this->handles_, this->get_pose_()),
        tr("apply %1").arg(QString::fromStdString(stored_entry.name)));
    });
  QObject::connect(list, &PoseListWidget::remove_requested, this,
    [this](int entry)
    {
      this->stored_poses_.library.remove(static_cast<std::size_t>(entry));
      this->change_stored_poses(tr("delete a pose"));
    });
  QObject::connect(list, &PoseListWidget::renamed, this,
    [this](int entry, const QString& name)
    {
      if (!this->stored_poses_.library.rename(static_cast<std::size_t>(entry), name.toStdString()))
      {
        Q_EMIT this->failed(name.isEmpty() ? tr("The name of a pose must not be empty.")
                                           : tr("Another pose already has this name."));
        this->show_stored_poses();
        return;
      }
      this->change_stored_poses(tr("rename a pose"));
    });
  QObject::connect(list, &PoseListWidget::blended, this,
    [this](int entry, double fraction)
    {
      if (!this->handles_ || entry < 0)
      {
        return;
      }
      if (this->blend_from_.empty())
      {
        this->blend_from_ = this->get_pose_();
      }
      const Pose to =
        this->stored_poses_.library.entries()[static_cast<std::size_t>(entry)].pose.for_handles(
          *this->handles_, this->blend_from_);
      Q_EMIT this->pose_requested(
        blend(*this->handles_, this->blend_from_, to, fraction), QString());
    });
  QObject::connect(list, &PoseListWidget::blend_ended, this,
    [this]
    {
      if (!this->blend_from_.empty())
      {
        this->blend_from_.clear();
        Q_EMIT this->pose_step_requested(tr("blend poses"));
      }
    });
}

void StoredPoseManager::change_stored_poses(const QString& step)
{
  this->show_stored_poses();
  Q_EMIT this->stored_poses_changed(step);
}

void StoredPoseManager::show_stored_poses()
{
  QStringList names;
  for (const PoseLibrary::Entry& entry : this->stored_poses_.library.entries())
  {
    names << QString::fromStdString(entry.name);
  }
  this->list_->set_names(names);
  this->strip_->set_keys(this->stored_poses_.keys);
}

void StoredPoseManager::set_stored_poses(const StoredPoses& stored_poses)
{
  this->play(false);
  this->stored_poses_ = stored_poses;
  this->show_stored_poses();
}

// ---- Key frames --------------------------------------------------------------------------------

void StoredPoseManager::connect_strip()
{
  KeyStrip* strip = this->strip_;
  QObject::connect(strip, &KeyStrip::play_requested, this, &StoredPoseManager::play);
  QObject::connect(strip, &KeyStrip::scrubbed, this, &StoredPoseManager::scrub);
  QObject::connect(strip, &KeyStrip::scrub_ended, this,
    [this]
    {
      if (!this->stored_poses_.keys.keys().empty())
      {
        Q_EMIT this->pose_step_requested(tr("go to %1 s").arg(this->key_time_, 0, 'f', 2));
      }
    });
  QObject::connect(strip, &KeyStrip::set_key_requested, this, &StoredPoseManager::set_key);
  QObject::connect(strip, &KeyStrip::remove_requested, this,
    [this](int key)
    {
      if (key >= 0)
      {
        this->stored_poses_.keys.remove(static_cast<std::size_t>(key));
        this->change_stored_poses(tr("delete a key"));
      }
    });
  QObject::connect(strip, &KeyStrip::key_moved, this,
    [this](int key, double seconds)
    {
      const std::size_t at = this->stored_poses_.keys.move(static_cast<std::size_t>(key), seconds);
      this->change_stored_poses(tr("move a key"));
      this->key_time_ = this->stored_poses_.keys.keys()[at].time;
      this->strip_->set_time(this->key_time_);
    });
  QObject::connect(strip, &KeyStrip::loop_chosen, this,
    [this](bool loop)
    {
      this->stored_poses_.keys.loop = loop;
      this->change_stored_poses(tr("loop"));
    });
  QObject::connect(strip, &KeyStrip::smooth_chosen, this,
    [this](bool smooth)
    {
      this->stored_poses_.keys.interpolation =
        smooth ? KeyInterpolation::spline : KeyInterpolation::linear;
      this->change_stored_poses(tr("interpolation between keys"));
    });
  QObject::connect(strip, &KeyStrip::rate_chosen, this,
    [this](double rate)
    {
      this->stored_poses_.keys.frames_per_second = rate;
      this->change_stored_poses(tr("frames per second"));
    });
}

void StoredPoseManager::set_key()
{
  if (this->handles_)
  {
    this->stored_poses_.keys.set(this->key_time_, NamedPose(*this->handles_, this->get_pose_()));
    this->change_stored_poses(tr("set a key"));
    this->strip_->set_time(this->key_time_);
  }
}

Pose StoredPoseManager::key_pose(double seconds) const
{
  const int key = this->stored_poses_.keys.index_at(seconds);
  return this->stored_poses_.keys.pose_at(
    key >= 0 ? this->stored_poses_.keys.keys()[static_cast<std::size_t>(key)].time : seconds,
    *this->handles_, this->get_pose_());
}

void StoredPoseManager::scrub(double seconds)
{
  this->play(false);
  this->key_time_ = seconds;
  this->strip_->set_time(seconds);
  if (this->handles_ && !this->stored_poses_.keys.keys().empty())
  {
    Q_EMIT this->pose_requested(this->key_pose(seconds), QString());
  }
}

void StoredPoseManager::play(bool play)
{
  const bool was_playing = this->play_timer_.isActive();
  const bool can_play = this->handles_ && this->stored_poses_.keys.keys().size() > 1;
  if (play && can_play && !was_playing)
  {
    if (this->key_time_ >= this->stored_poses_.keys.duration())
    {
      this->key_time_ = 0.0;
    }
    this->key_clock_.start();
    this->play_timer_.start();
  }
  else if (!play && was_playing)
  {
    this->play_timer_.stop();
    Q_EMIT this->pose_step_requested(tr("play"));
  }
  this->strip_->set_playing(this->play_timer_.isActive());
}

void StoredPoseManager::tick()
{
  const double length = this->stored_poses_.keys.duration();
  double time = this->key_time_ + 1e-9 * static_cast<double>(this->key_clock_.nsecsElapsed());
  this->key_clock_.restart();
  const bool reached_end = time >= length && !this->stored_poses_.keys.loop;
  time = reached_end ? length : time >= length ? std::fmod(time, length) : time;
  this->key_time_ = time;
  this->strip_->set_time(time);
  Q_EMIT this->pose_requested(this->key_pose(time), QString());
  if (reached_end)
  {
    this->play(false);
  }
}

} // namespace app::posing
