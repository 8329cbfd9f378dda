#ifndef document_recent_files_h
#define document_recent_files_h

#include <QStringList>

/// The files that were opened last, the latest first, over the program's runs (QSettings).
class RecentFiles
{
public:
  static constexpr int most = 10;

  static QStringList list();
  static void add(const QString& path);
  static void clear();
};

#endif
