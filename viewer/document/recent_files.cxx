#include "document/recent_files.h"

#include "document/user_settings.h"

#include <QFileInfo>
#include <QSettings>

namespace
{
const char* const key = "recent_files";
} // namespace

QStringList RecentFiles::list()
{
  return user_settings()->value(key).toStringList().mid(0, maximum_count);
}

void RecentFiles::add(const QString& path)
{
  const QString absolute = QFileInfo(path).absoluteFilePath();
  QStringList paths = list();
  paths.removeAll(absolute);
  paths.prepend(absolute);
  user_settings()->setValue(key, QStringList(paths.mid(0, maximum_count)));
}

void RecentFiles::clear()
{
  user_settings()->remove(key);
}
