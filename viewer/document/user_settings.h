#ifndef user_settings_h
#define user_settings_h

#include <memory>

class QSettings;

/// Return the user's settings, which are kept between runs of the program. They do not depend on
/// the open files.
std::unique_ptr<QSettings> user_settings();

#endif
