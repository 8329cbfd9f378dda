#ifndef document_session_h
#define document_session_h

#include "base/status.h"
#include "document/work.h"

#include <QStringList>

#include <array>
#include <memory>
#include <optional>

/// From where a window looks; no part of the work.
struct SessionView
{
  struct Camera
  {
    std::array<double, 3> position{ 0, 0, 1 }, focal_point{ 0, 0, 0 }, up{ 0, 1, 0 };
    double angle = 30.0; ///< degrees
    double scale = 1.0; ///< of a parallel camera: half the height
    bool parallel = false;
  };
  std::optional<Camera> camera;
  int panel = 0; ///< that is shown, of PanelColumn
};

/// A file that a session was made from and that is not there, or not as it was.
struct LostInput
{
  QString role; ///< "mesh", "handles", "picture", "volume", "curves"
  QString path; ///< where it was looked for
  QByteArray checksum; ///< that it had
};

struct Session
{
  Work work;
  SessionView view;
  QString saved_as; ///< of a recovered one: the session file that it is a later state of
  std::vector<LostInput> lost; ///< inputs that are missing and that nothing stands for
  QStringList notes; ///< sentences about what is missing or has changed
};

/// **Session files** (`NAME.bindpose`) are JSON; viewer/sessions_and_tours.md documents the schema.
/// Inputs are named by paths relative to the session file and by their SHA-256; what no input
/// holds, surfaces, weights and volumes that were made here, is in companions beside it,
/// `NAME.surface-HASH.vtp`, `NAME.tets-HASH.vtu` and `NAME.volume-HASH.vti`, named after their
/// contents.
///
/// Nothing is ever half-written: companions are on the disk before the session that names them
/// takes the place of the last one, in one step, and only then those that nobody names any more
/// go. A process that is killed anywhere leaves the last session or the new one.
///
/// To write beside the window: prepare() on its thread, which takes no time, then write() on
/// another; what was prepared is dropped on the first again.
class SessionFile
{
public:
  struct Prepared; ///< a session as text, and its datasets, which nobody changes
  static std::shared_ptr<const Prepared> prepare(const QString& path, const Session& session);
  /// Writes the session; companions that this object has written there already stay as they are.
  bindpose::Status write(const Prepared& prepared);
  bindpose::Status write(const QString& path, const Session& session);

private:
  struct Companion
  {
    vtkSmartPointer<vtkDataSet> data; // that was written
    QString session; // for which session file
    QString name;
    QByteArray checksum;
  };
  bindpose::Status write_companion(
    const QString& session, const QString& role, vtkDataSet* data, Companion& companion);

  Companion surface_, tets_, volume_;
};

/// Reads a session file of this or an older schema. invalid_input, one sentence, for what is no
/// session, broken, or of a newer program. Inputs that are missing or other than they were are no
/// errors: see Session.
bindpose::Status read_session(const QString& path, Session& session);

constexpr const char* session_ending = "bindpose";
constexpr int session_schema = 1;

#endif
