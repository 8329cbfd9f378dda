#include "style.h"

#include <QApplication>
#include <QFont>
#include <QPalette>
#include <QStyleFactory>

namespace
{
const char* const sheet = R"(
QMainWindow, QDialog { background: #f4f4f2; }
QMenuBar { background: #f4f4f2; padding: 2px 6px; }
QMenuBar::item { padding: 4px 9px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: #e3e3df; }
QMenu { background: #ffffff; border: 1px solid #d4d4cf; padding: 4px; }
QMenu::item { padding: 5px 26px 5px 14px; border-radius: 4px; }
QMenu::item:selected { background: #e6eef6; }
QMenu::separator { height: 1px; background: #e6e6e2; margin: 4px 8px; }
QStatusBar { background: #f4f4f2; color: #5c5c58; }
QStatusBar::item { border: none; }
QFrame#panel { background: #fbfbfa; border: none; border-left: 1px solid #dededa; }
QLabel#heading { color: #77776f; font-weight: 600; }
QLabel#note { color: #77776f; }
QPushButton { background: #ffffff; border: 1px solid #cfcfca; border-radius: 5px; padding: 5px 12px; }
QPushButton:hover { border-color: #9c9c95; }
QPushButton:pressed { background: #efefec; }
QPushButton:disabled { color: #aaaaa4; background: #f6f6f4; border-color: #e2e2de; }
QPushButton#primary { background: #2b6ca8; border-color: #2b6ca8; color: #ffffff; font-weight: 600; }
QPushButton#primary:hover { background: #245c90; }
QPushButton#primary:disabled { background: #b9cbdb; border-color: #b9cbdb; color: #f3f6f9; }
QPushButton#segment { border-radius: 0; padding: 5px 6px; }
QPushButton#segment:checked { background: #2b6ca8; border-color: #2b6ca8; color: #ffffff; }
QComboBox { background: #ffffff; border: 1px solid #cfcfca; border-radius: 5px; padding: 4px 8px; }
QComboBox:disabled { color: #aaaaa4; }
QComboBox QAbstractItemView { background: #ffffff; selection-background-color: #e6eef6; selection-color: #1f1f1d; }
QListWidget { background: #ffffff; border: 1px solid #dededa; border-radius: 5px; outline: none; }
QListWidget::item { padding: 4px 6px; }
QListWidget::item:selected { background: #e6eef6; color: #1f1f1d; }
QProgressBar { background: #e9e9e5; border: none; border-radius: 3px; max-height: 6px; }
QProgressBar::chunk { background: #2b6ca8; border-radius: 3px; }
QFrame#error { background: #fbe9e7; border: none; border-bottom: 1px solid #e6b8b2; }
QFrame#error QLabel { color: #7c1f14; }
QFrame#error QPushButton { border: none; background: transparent; color: #7c1f14; font-weight: 600; padding: 2px 8px; }
QToolTip { background: #ffffe9; color: #1f1f1d; border: 1px solid #d4d4b8; padding: 3px; }
)";
}

void apply_style(QApplication& application)
{
  application.setStyle(QStyleFactory::create("Fusion"));
  QPalette palette;
  palette.setColor(QPalette::Window, QColor("#f4f4f2"));
  palette.setColor(QPalette::WindowText, QColor("#1f1f1d"));
  palette.setColor(QPalette::Base, QColor("#ffffff"));
  palette.setColor(QPalette::AlternateBase, QColor("#f8f8f6"));
  palette.setColor(QPalette::Text, QColor("#1f1f1d"));
  palette.setColor(QPalette::Button, QColor("#ffffff"));
  palette.setColor(QPalette::ButtonText, QColor("#1f1f1d"));
  palette.setColor(QPalette::Highlight, QColor("#2b6ca8"));
  palette.setColor(QPalette::HighlightedText, QColor("#ffffff"));
  application.setPalette(palette);
  QFont font = application.font();
  font.setPointSizeF(10.0);
  application.setFont(font);
  application.setStyleSheet(sheet);
}
