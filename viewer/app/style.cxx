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
QMenu::item { padding: 5px 22px 5px 26px; border-radius: 4px; }
QMenu::item:selected { background: #e6eef6; }
QMenu::item:disabled { color: #8f8f88; background: transparent; }
QMenu::indicator { left: 7px; width: 14px; height: 14px; }
QMenu::separator { height: 1px; background: #e6e6e2; margin: 4px 8px; }
QStatusBar { background: #f4f4f2; border-top: 1px solid #dededa; }
QStatusBar QLabel { color: #4c4c48; }
QStatusBar::item { border: none; }
QFrame#panel { background: #fbfbfa; border: none; border-left: 1px solid #dededa; }
QLabel#heading { color: #66665f; font-weight: 600; }
QLabel#note { color: #66665f; }
QLabel#empty { color: #66665f; background: transparent; }
QLabel:disabled { color: #8f8f88; }
QPushButton { background: #ffffff; border: 1px solid #cfcfca; border-radius: 5px; padding: 5px 12px; outline: none; }
QPushButton:hover { border-color: #9c9c95; }
QPushButton:pressed { background: #efefec; }
QPushButton:focus { border: 2px solid #2b6ca8; padding: 4px 11px; }
QPushButton:disabled { color: #8f8f88; background: #f6f6f4; border-color: #e2e2de; }
QPushButton#primary { background: #2b6ca8; border-color: #2b6ca8; color: #ffffff; font-weight: 600; }
QPushButton#primary:hover { background: #245c90; }
QPushButton#primary:pressed { background: #1d4b76; }
QPushButton#primary:focus { border-color: #12324f; }
QPushButton#primary:disabled { background: #d3dde6; border-color: #d3dde6; color: #71869a; }
QPushButton#segment { border-radius: 0; padding: 5px 6px; }
QPushButton#segment[place="first"] { border-top-left-radius: 5px; border-bottom-left-radius: 5px; border-right: none; }
QPushButton#segment[place="last"] { border-top-right-radius: 5px; border-bottom-right-radius: 5px; border-left: none; }
QPushButton#segment[place="second"] { border-right: none; }
QPushButton#segment:checked { background: #2b6ca8; border-color: #2b6ca8; color: #ffffff; }
QPushButton#segment:checked:disabled { background: #d3dde6; border-color: #d3dde6; color: #71869a; }
QPushButton#segment:focus { border: 2px solid #12324f; padding: 4px 5px; }
QPushButton#section { border: none; border-top: 1px solid #e6e6e2; border-radius: 0; background: transparent; color: #66665f; font-weight: 600; text-align: left; padding: 7px 0 3px 0; }
QPushButton#section:hover { color: #1f1f1d; }
QPushButton#section:focus { border: none; border-top: 2px solid #2b6ca8; padding: 6px 0 3px 0; }
QPushButton#toggle:checked { background: #d8e5f1; border-color: #2b6ca8; }
QFrame#tools { background: #fbfbfa; border: none; border-bottom: 1px solid #dededa; }
QFrame#tools QToolButton { border: 1px solid transparent; border-radius: 5px; padding: 3px 6px; }
QFrame#tools QToolButton:hover { border-color: #cfcfca; background: #ffffff; }
QFrame#tools QToolButton:checked { background: #2b6ca8; border-color: #2b6ca8; color: #ffffff; }
QFrame#tools QToolButton:checked:disabled { background: #d3dde6; border-color: #d3dde6; color: #71869a; }
QFrame#tools QToolButton:disabled { color: #a8a8a2; }
QFrame#tools QToolButton:focus { border: 2px solid #12324f; padding: 2px 5px; }
QFrame#mode { background: rgba(251, 251, 250, 235); border: 1px solid #dededa; border-radius: 7px; }
QLabel#nothing { background: rgba(251, 251, 250, 225); border: 1px solid #dededa; border-radius: 7px; padding: 9px 14px; color: #4c4c48; }
QTableWidget#sheet { background: #ffffff; border: 1px solid #dededa; border-radius: 5px; }
QLineEdit { background: #ffffff; border: 1px solid #cfcfca; border-radius: 5px; padding: 4px 8px; }
QLineEdit:focus { border-color: #2b6ca8; }
QScrollArea#scroll { background: transparent; border: none; }
QWidget#scrolled { background: #fbfbfa; }
QFrame#strip { background: #fbfbfa; border: none; border-top: 1px solid #dededa; }
QComboBox { background: #ffffff; border: 1px solid #cfcfca; border-radius: 5px; padding: 4px 8px; }
QComboBox:hover { border-color: #9c9c95; }
QComboBox:focus { border-color: #2b6ca8; }
QComboBox:disabled { color: #8f8f88; background: #f6f6f4; border-color: #e2e2de; }
QComboBox::drop-down { border: none; width: 22px; }
QComboBox::down-arrow { image: url(:/bindpose/down.png); width: 10px; height: 6px; }
QComboBox::down-arrow:disabled { image: url(:/bindpose/down-disabled.png); }
QComboBox QAbstractItemView { background: #ffffff; selection-background-color: #e6eef6; selection-color: #1f1f1d; }
QCheckBox { spacing: 8px; }
QCheckBox:disabled { color: #8f8f88; }
QDoubleSpinBox { background: #ffffff; border: 1px solid #cfcfca; border-radius: 5px; padding: 3px 6px; }
QDoubleSpinBox:hover { border-color: #9c9c95; }
QDoubleSpinBox:focus { border-color: #2b6ca8; }
QDoubleSpinBox:disabled { color: #8f8f88; background: #f6f6f4; border-color: #e2e2de; }
QSlider::groove:horizontal { height: 4px; background: #dededa; border-radius: 2px; }
QSlider::sub-page:horizontal { background: #2b6ca8; border-radius: 2px; }
QSlider::sub-page:horizontal:disabled { background: #d3dde6; }
QSlider::handle:horizontal { width: 14px; margin: -6px 0; border-radius: 8px; background: #ffffff; border: 1px solid #9c9c95; }
QSlider::handle:horizontal:hover { border-color: #2b6ca8; }
QSlider::handle:horizontal:focus { border: 2px solid #12324f; }
QListWidget { background: #ffffff; border: 1px solid #dededa; border-radius: 5px; outline: none; }
QListWidget:focus { border-color: #2b6ca8; }
QListWidget::item { padding: 4px 6px; border: none; }
QListWidget::item:hover { background: #f2f5f8; }
QListWidget::item:selected { background: #d8e5f1; color: #1f1f1d; }
QScrollBar:vertical { background: transparent; width: 10px; margin: 2px; }
QScrollBar:horizontal { background: transparent; height: 10px; margin: 2px; }
QScrollBar::handle { background: #c4c4be; border-radius: 3px; min-height: 24px; min-width: 24px; }
QScrollBar::handle:hover { background: #9c9c95; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QProgressBar { background: #e9e9e5; border: none; border-radius: 3px; max-height: 6px; }
QProgressBar::chunk { background: #2b6ca8; border-radius: 3px; }
QFrame#error { background: #fbe9e7; border: none; border-bottom: 1px solid #e6b8b2; }
QFrame#error QLabel { color: #7c1f14; }
QFrame#error QPushButton { border: none; background: transparent; color: #7c1f14; font-weight: 600; padding: 2px 8px; }
QFrame#notice { background: #eaf1f8; border: none; border-bottom: 1px solid #bfd3e6; }
QFrame#notice QLabel { color: #12324f; }
QFrame#notice QPushButton { padding: 3px 10px; }
QFrame#notice QPushButton:focus { padding: 2px 9px; }
QToolTip { background: #ffffe9; color: #1f1f1d; border: 1px solid #d4d4b8; padding: 3px; }
)";
}

void apply_style(QApplication& application)
{
  Q_INIT_RESOURCE(app); // of a static library: else the linker leaves it out
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
