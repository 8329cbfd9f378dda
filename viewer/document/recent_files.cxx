#include "document/recent_files.h"

#include <QFileInfo>
#include <QSettings>

#include <memory>

namespace
{
const char* const key = "recent_files";

std::unique_ptr<QSettings> settings()
{
  return std::make_unique<QSettings>(
    QSettings::IniFormat, QSettings::UserScope, "bindpose", "bindpose");
}
} // namespace

QStringList RecentFiles::list()
{
  return settings()->value(key).toStringList().mid(0, most);
}

void RecentFiles::add(const QString& path)
{
  const QString absolute = QFileInfo(path).absoluteFilePath();
  QStringList paths = list();
  paths.removeAll(absolute);
  paths.prepend(absolute);
  settings()->setValue(key, QStringList(paths.mid(0, most)));
}

void RecentFiles::clear()
{
  settings()->remove(key);
}
