#ifndef bindpose_tests_viewer_app_opened_folders_h
#define bindpose_tests_viewer_app_opened_folders_h

#include <QDesktopServices>
#include <QList>
#include <QObject>
#include <QUrl>

namespace bindpose::test
{

/// Handles requests to open folders in place of the desktop. Records the URLs and opens nothing.
class OpenedFolders : public QObject
{
  Q_OBJECT

public:
  OpenedFolders() { QDesktopServices::setUrlHandler("file", this, "open"); }
  ~OpenedFolders() override { QDesktopServices::unsetUrlHandler("file"); }
  const QList<QUrl>& urls() const { return this->urls_; }

public Q_SLOTS:
  void open(const QUrl& url) { this->urls_ << url; }

private:
  QList<QUrl> urls_;
};

} // namespace bindpose::test

#endif
