#ifndef user_settings_h
#define user_settings_h

#include <memory>

class QSettings;

/// What is kept over the program's runs, whatever is opened.
std::unique_ptr<QSettings> user_settings();

#endif
