#ifndef document_recent_files_h
#define document_recent_files_h

#include <QStringList>

/// List of the most recently opened files; the latest file is first. The list is kept between runs
/// of the program (QSettings).
class RecentFiles
{
public:
  static constexpr int maximum_count = 10;

  static QStringList list();
  static void add(const QString& path);
  static void clear();
};

#endif
