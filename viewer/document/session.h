#ifndef document_session_h
#define document_session_h

#include "base/status.h"
#include "document/work.h"

#include <QStringList>

#include <array>
#include <memory>
#include <optional>

/// The camera and the selected panel of a window. Sessions store them in addition to the Work.
struct SessionView
{
  struct Camera
  {
    std::array<double, 3> position{ 0, 0, 1 }, focal_point{ 0, 0, 0 }, up{ 0, 1, 0 };
    double angle = 30.0; ///< degrees
    double scale = 1.0; ///< half the height of the view in world units, for a parallel camera
    bool parallel = false;
  };
  std::optional<Camera> camera;
  int panel = 0; ///< index of the visible panel in PanelColumn
};

/// An input file of a session that is missing or cannot be read.
struct MissingInput
{
  QString role; ///< role of the input: "mesh", "handles", "picture", "volume" or "curves"
  QString path; ///< the path at which the file was expected
  QByteArray checksum; ///< checksum of the file when the session was saved
};

struct Session
{
  Work work;
  SessionView view;
  QString saved_as; ///< for recovered work: the session file that an earlier state was saved to
  std::vector<MissingInput> missing_inputs; ///< missing inputs for which no stored copy exists
  QStringList notes; ///< messages about missing or changed files
};

/// **Session files** (`NAME.bindpose`) are JSON; viewer/sessions_and_tours.md documents the schema.
/// A session refers to its inputs by paths relative to the session file and by their SHA-256.
/// Surfaces, weights and volumes that were made in the program are stored in companion files in the
/// same folder: `NAME.surface-HASH.vtp`, `NAME.tets-HASH.vtu` and `NAME.volume-HASH.vti`. HASH
/// depends on the contents.
///
/// Writing is atomic. First the companions are written to the disk, then the new session replaces
/// the old one in one step. After that, companions that are no longer referenced are deleted. If
/// the process is killed at any time, the old session or the new one is intact.
///
/// To write in the background, call prepare() on the window's thread, and then write() on another
/// thread. prepare() takes almost no time. The prepared session must be destroyed on the window's
/// thread.
class SessionFile
{
public:
  /// The text of a session file, and the datasets for its companion files. Nothing modifies these
  /// datasets.
  struct PreparedSession;
  static std::shared_ptr<const PreparedSession> prepare(
    const QString& path, const Session& session);
  /// Write the session. Companions that this object has already written to the same folder are not
  /// written again.
  bindpose::Status write(const PreparedSession& prepared);
  bindpose::Status write(const QString& path, const Session& session);

private:
  struct Companion
  {
    vtkSmartPointer<vtkDataSet> data; // the dataset that was written
    QString session; // path of the session file that uses the companion
    QString name;
    QByteArray checksum;
  };
  bindpose::Status write_companion(
    const QString& session, const QString& role, vtkDataSet* data, Companion& companion);

  Companion surface_, tets_, volume_;
};

/// Read a session file of this or an older schema. Return invalid_input, with one sentence, if the
/// file is not a session, is damaged, or is from a newer program. Missing or changed inputs are not
/// errors; Session lists them.
bindpose::Status read_session(const QString& path, Session& session);

constexpr const char* session_extension = "bindpose";
constexpr int session_schema = 1;

#endif
