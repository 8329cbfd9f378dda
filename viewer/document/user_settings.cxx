#include "document/user_settings.h"

#include <QSettings>

std::unique_ptr<QSettings> user_settings()
{
  return std::make_unique<QSettings>(
    QSettings::IniFormat, QSettings::UserScope, "bindpose", "bindpose");
}
