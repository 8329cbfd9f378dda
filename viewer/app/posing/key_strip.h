#ifndef app_posing_key_strip_h
#define app_posing_key_strip_h

#include "poses/key_frames.h"

#include <QFrame>

class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace app::posing
{

class KeyTrack;

/// The strip of key frames below the 3D view: a track with one mark per key frame (key), and
/// buttons that play the keys and set a key. Users drag the mouse on the track to change the
/// displayed time (scrub) or to move a key. The window sets the contents.
class KeyStrip : public QFrame
{
  Q_OBJECT

public:
  explicit KeyStrip(QWidget* parent = nullptr);

  void set_keys(const bindpose::KeyFrames& keys);
  void set_time(double seconds);
  void set_playing(bool playing);
  void set_ready(bool ready);
  double time() const { return this->time_; }
  KeyTrack* track() const { return this->track_; }

Q_SIGNALS:
  void play_requested(bool play);
  void scrubbed(double seconds);
  void scrub_ended();
  void set_key_requested();
  void remove_requested(int key);
  void key_moved(int key, double seconds);
  void loop_chosen(bool loop);
  void smooth_chosen(bool smooth);
  void rate_chosen(double frames_per_second);

private:
  void enable();

  KeyTrack* track_;
  QPushButton* play_;
  QPushButton* add_;
  QPushButton* remove_;
  QPushButton* loop_;
  QPushButton* smooth_;
  QDoubleSpinBox* rate_;
  QLabel* time_label_;
  bindpose::KeyFrames keys_;
  double time_ = 0.0;
  bool ready_ = false;
  bool playing_ = false;
};

/// The track: time increases from left to right.
class KeyTrack : public QWidget
{
  Q_OBJECT

public:
  explicit KeyTrack(QWidget* parent = nullptr);

  void set_keys(const bindpose::KeyFrames& keys);
  void set_time(double seconds);
  /// Return the position at which a time is drawn, in pixels from the left.
  int pixel(double seconds) const;
  QSize sizeHint() const override;

Q_SIGNALS:
  void scrubbed(double seconds);
  void scrub_ended();
  void key_moved(int key, double seconds);

protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  double length() const;
  double seconds_at(int x) const;
  int key_at(const QPoint& at) const;

  bindpose::KeyFrames keys_;
  double time_ = 0.0;
  int dragged_key_ = -1; ///< index of the dragged key; -1: none
  double dragged_time_ = 0.0;
  bool moved_ = false;
  bool scrubbing_ = false;
};

} // namespace app::posing

#endif
