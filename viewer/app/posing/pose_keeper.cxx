#include "app/posing/pose_keeper.h"

#include "app/posing/key_strip.h"
#include "app/posing/pose_list.h"

#include "poses/pose_blend.h"

#include <cmath>

using namespace bindpose;

namespace
{
constexpr int display_interval = 16; // milliseconds
}

PoseKeeper::PoseKeeper(PoseList* list, KeyStrip* strip, std::function<Pose()> pose, QObject* parent)
  : QObject(parent), list_(list), strip_(strip), pose_(std::move(pose))
{
  this->connect_list();
  this->connect_strip();
  this->playing_.setTimerType(Qt::PreciseTimer);
  this->playing_.setInterval(display_interval);
  QObject::connect(&this->playing_, &QTimer::timeout, this, &PoseKeeper::tick);
}

void PoseKeeper::set_handles(const std::shared_ptr<const Handles>& handles)
{
  this->handles_ = handles;
  this->list_->set_ready(handles != nullptr);
  this->strip_->set_ready(handles != nullptr);
}

// ---- Stored poses ------------------------------------------------------------------------------

void PoseKeeper::connect_list()
{
  PoseList* list = this->list_;
  QObject::connect(list, &PoseList::store_wanted, this,
    [this]
    {
      this->shelf_.library.store(
        tr("pose").toStdString(), NamedPose(*this->handles_, this->pose_()));
      this->change_shelf(tr("store a pose"));
      this->list_->choose(static_cast<int>(this->shelf_.library.entries().size()) - 1);
    });
  QObject::connect(list, &PoseList::apply_wanted, this,
    [this](int entry)
    {
      const auto& kept = this->shelf_.library.entries()[static_cast<std::size_t>(entry)];
      Q_EMIT this->pose_wanted(kept.pose.of(*this->handles_, this->pose_()),
        tr("apply %1").arg(QString::fromStdString(kept.name)));
    });
  QObject::connect(list, &PoseList::remove_wanted, this,
    [this](int entry)
    {
      this->shelf_.library.remove(static_cast<std::size_t>(entry));
      this->change_shelf(tr("delete a pose"));
    });
  QObject::connect(list, &PoseList::renamed, this,
    [this](int entry, const QString& name)
    {
      if (!this->shelf_.library.rename(static_cast<std::size_t>(entry), name.toStdString()))
      {
        Q_EMIT this->failed(name.isEmpty() ? tr("The name of a pose must not be empty.")
                                           : tr("Another pose already has this name."));
        this->show_shelf();
        return;
      }
      this->change_shelf(tr("rename a pose"));
    });
  QObject::connect(list, &PoseList::blended, this,
    [this](int entry, double share)
    {
      if (!this->handles_ || entry < 0)
      {
        return;
      }
      if (this->blend_from_.empty())
      {
        this->blend_from_ = this->pose_();
      }
      const Pose to = this->shelf_.library.entries()[static_cast<std::size_t>(entry)].pose.of(
        *this->handles_, this->blend_from_);
      Q_EMIT this->pose_wanted(blend(*this->handles_, this->blend_from_, to, share), QString());
    });
  QObject::connect(list, &PoseList::blend_ended, this,
    [this]
    {
      if (!this->blend_from_.empty())
      {
        this->blend_from_.clear();
        Q_EMIT this->pose_done(tr("blend poses"));
      }
    });
}

void PoseKeeper::change_shelf(const QString& step)
{
  this->show_shelf();
  Q_EMIT this->shelf_changed(step);
}

void PoseKeeper::show_shelf()
{
  QStringList names;
  for (const PoseLibrary::Entry& entry : this->shelf_.library.entries())
  {
    names << QString::fromStdString(entry.name);
  }
  this->list_->set_names(names);
  this->strip_->set_keys(this->shelf_.keys);
}

void PoseKeeper::set_shelf(const PoseShelf& shelf)
{
  this->play(false);
  this->shelf_ = shelf;
  this->show_shelf();
}

// ---- Key frames --------------------------------------------------------------------------------

void PoseKeeper::connect_strip()
{
  KeyStrip* strip = this->strip_;
  QObject::connect(strip, &KeyStrip::play_wanted, this, &PoseKeeper::play);
  QObject::connect(strip, &KeyStrip::scrubbed, this, &PoseKeeper::scrub);
  QObject::connect(strip, &KeyStrip::scrub_ended, this,
    [this]
    {
      if (!this->shelf_.keys.keys().empty())
      {
        Q_EMIT this->pose_done(tr("go to %1 s").arg(this->key_time_, 0, 'f', 2));
      }
    });
  QObject::connect(strip, &KeyStrip::key_wanted, this, &PoseKeeper::set_key);
  QObject::connect(strip, &KeyStrip::remove_wanted, this,
    [this](int key)
    {
      if (key >= 0)
      {
        this->shelf_.keys.remove(static_cast<std::size_t>(key));
        this->change_shelf(tr("delete a key"));
      }
    });
  QObject::connect(strip, &KeyStrip::key_moved, this,
    [this](int key, double seconds)
    {
      const std::size_t at = this->shelf_.keys.move(static_cast<std::size_t>(key), seconds);
      this->change_shelf(tr("move a key"));
      this->key_time_ = this->shelf_.keys.keys()[at].time;
      this->strip_->set_time(this->key_time_);
    });
  QObject::connect(strip, &KeyStrip::loop_chosen, this,
    [this](bool loop)
    {
      this->shelf_.keys.loop = loop;
      this->change_shelf(tr("loop"));
    });
  QObject::connect(strip, &KeyStrip::smooth_chosen, this,
    [this](bool smooth)
    {
      this->shelf_.keys.interpolation =
        smooth ? KeyInterpolation::spline : KeyInterpolation::linear;
      this->change_shelf(tr("interpolation between keys"));
    });
  QObject::connect(strip, &KeyStrip::rate_chosen, this,
    [this](double rate)
    {
      this->shelf_.keys.frames_per_second = rate;
      this->change_shelf(tr("frames per second"));
    });
}

void PoseKeeper::set_key()
{
  if (this->handles_)
  {
    this->shelf_.keys.set(this->key_time_, NamedPose(*this->handles_, this->pose_()));
    this->change_shelf(tr("set a key"));
    this->strip_->set_time(this->key_time_);
  }
}

Pose PoseKeeper::key_pose(double seconds) const
{
  const int key = this->shelf_.keys.at(seconds);
  return this->shelf_.keys.pose_at(
    key >= 0 ? this->shelf_.keys.keys()[static_cast<std::size_t>(key)].time : seconds,
    *this->handles_, this->pose_());
}

void PoseKeeper::scrub(double seconds)
{
  this->play(false);
  this->key_time_ = seconds;
  this->strip_->set_time(seconds);
  if (this->handles_ && !this->shelf_.keys.keys().empty())
  {
    Q_EMIT this->pose_wanted(this->key_pose(seconds), QString());
  }
}

void PoseKeeper::play(bool play)
{
  const bool was = this->playing_.isActive();
  const bool can = this->handles_ && this->shelf_.keys.keys().size() > 1;
  if (play && can && !was)
  {
    if (this->key_time_ >= this->shelf_.keys.duration())
    {
      this->key_time_ = 0.0;
    }
    this->key_clock_.start();
    this->playing_.start();
  }
  else if (!play && was)
  {
    this->playing_.stop();
    Q_EMIT this->pose_done(tr("play"));
  }
  this->strip_->set_playing(this->playing_.isActive());
}

void PoseKeeper::tick()
{
  const double length = this->shelf_.keys.duration();
  double time = this->key_time_ + 1e-9 * static_cast<double>(this->key_clock_.nsecsElapsed());
  this->key_clock_.restart();
  const bool ends = time >= length && !this->shelf_.keys.loop;
  time = ends ? length : time >= length ? std::fmod(time, length) : time;
  this->key_time_ = time;
  this->strip_->set_time(time);
  Q_EMIT this->pose_wanted(this->key_pose(time), QString());
  if (ends)
  {
    this->play(false);
  }
}
