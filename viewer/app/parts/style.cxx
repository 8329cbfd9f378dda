// Light and dark colors of the window. In the style sheet, colors are named by their purpose
// (@panel, @ink). The table shades[] has a light and a dark value for each name.
#include "app/parts/style.h"

#include "document/user_settings.h"

#include <QApplication>
#include <QFont>
#include <QPalette>
#include <QSettings>
#include <QStyleFactory>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

/// Register the Qt resources explicitly, because the linker omits their initializer when it links a
/// static library. The macro cannot be used in a namespace.
static void init_resources()
{
  Q_INIT_RESOURCE(app);
}

namespace app::parts
{

namespace
{
struct ThemeColor
{
  const char* name;
  const char* light;
  const char* dark;
};
constexpr ThemeColor theme_colors[] = {
  { "window", "#f4f4f2", "#26272a" },
  { "panel", "#fbfbfa", "#2c2d31" },
  { "field", "#ffffff", "#35373b" },
  { "ink", "#1f1f1d", "#ececea" },
  { "status", "#4c4c48", "#c4c4c0" },
  { "note", "#66665f", "#a9a9a3" },
  { "off", "#8f8f88", "#7b7b76" },
  { "menu_edge", "#d4d4cf", "#46484d" },
  { "line", "#dededa", "#3d3f44" },
  { "faint", "#e6e6e2", "#3a3c41" },
  { "menu_hover", "#e3e3df", "#3a3c41" },
  { "chosen", "#e6eef6", "#2f4459" },
  { "picked", "#d8e5f1", "#2f4b66" },
  { "item_hover", "#f2f5f8", "#383b41" },
  { "edge", "#cfcfca", "#54565b" },
  { "edge_hover", "#9c9c95", "#7e7f84" },
  { "pressed", "#efefec", "#2f3034" },
  { "off_field", "#f6f6f4", "#2e2f33" },
  { "off_edge", "#e2e2de", "#404247" },
  { "accent", "#2b6ca8", "#3579b8" },
  { "accent_hover", "#245c90", "#4488c8" },
  { "accent_pressed", "#1d4b76", "#2a629a" },
  { "accent_ring", "#12324f", "#a9cdf0" },
  { "accent_off", "#d3dde6", "#33414f" },
  { "accent_off_ink", "#71869a", "#8296a9" },
  { "scroll", "#c4c4be", "#5a5c61" },
  { "trough", "#e9e9e5", "#3d3f44" },
  { "error", "#fbe9e7", "#4a2623" },
  { "error_edge", "#e6b8b2", "#6d3a34" },
  { "error_ink", "#7c1f14", "#f3b9b0" },
  { "notice", "#eaf1f8", "#24384b" },
  { "notice_edge", "#bfd3e6", "#3a5672" },
  { "tip", "#ffffe9", "#3b3b30" },
  { "tip_edge", "#d4d4b8", "#5a5a48" },
  { "on_accent", "#ffffff", "#ffffff" },
  { "notice_ink", "#12324f", "#cfe3f6" },
  { "key", "#f8d9ae", "#8a6a3c" },
  { "key_now", "#f2941f", "#f2941f" },
  { "key_edge", "#7a4a08", "#e0b376" },
  { "alternate", "#f8f8f6", "#313237" },
};

const char* const sheet = R"(
QMainWindow, QDialog { background: @window; }
QMenuBar { background: @window; padding: 2px 6px; }
QMenuBar::item { padding: 4px 9px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: @menu_hover; }
QMenu { background: @field; border: 1px solid @menu_edge; padding: 4px; }
QMenu::item { padding: 5px 22px 5px 26px; border-radius: 4px; }
QMenu::item:selected { background: @chosen; }
QMenu::item:disabled { color: @off; background: transparent; }
QMenu::indicator { left: 7px; width: 14px; height: 14px; }
QMenu::separator { height: 1px; background: @faint; margin: 4px 8px; }
QStatusBar { background: @window; border-top: 1px solid @line; }
QStatusBar QLabel { color: @status; }
QStatusBar::item { border: none; }
QFrame#panel { background: @panel; border: none; border-left: 1px solid @line; }
QLabel#heading { color: @note; font-weight: 600; }
QLabel#note { color: @note; }
QWidget#empty { background: transparent; }
QWidget#empty QLabel { color: @note; background: transparent; }
QLabel:disabled { color: @off; }
QPushButton { background: @field; border: 1px solid @edge; border-radius: 5px; padding: 5px 12px; outline: none; }
QPushButton:hover { border-color: @edge_hover; }
QPushButton:pressed { background: @pressed; }
QPushButton:focus { border: 2px solid @accent; padding: 4px 11px; }
QPushButton:disabled { color: @off; background: @off_field; border-color: @off_edge; }
QPushButton#primary { background: @accent; border-color: @accent; color: @on_accent; font-weight: 600; }
QPushButton#primary:hover { background: @accent_hover; }
QPushButton#primary:pressed { background: @accent_pressed; }
QPushButton#primary:focus { border-color: @accent_ring; }
QPushButton#primary:disabled { background: @accent_off; border-color: @accent_off; color: @accent_off_ink; }
QPushButton#segment { border-radius: 0; padding: 5px 6px; }
QPushButton#segment[place="first"] { border-top-left-radius: 5px; border-bottom-left-radius: 5px; border-right: none; }
QPushButton#segment[place="last"] { border-top-right-radius: 5px; border-bottom-right-radius: 5px; border-left: none; }
QPushButton#segment[place="second"] { border-right: none; }
QPushButton#segment:checked { background: @accent; border-color: @accent; color: @on_accent; }
QPushButton#segment:checked:disabled { background: @accent_off; border-color: @accent_off; color: @accent_off_ink; }
QPushButton#segment:focus { border: 2px solid @accent_ring; padding: 4px 5px; }
QPushButton#section { border: none; border-top: 1px solid @faint; border-radius: 0; background: transparent; color: @note; font-weight: 600; text-align: left; padding: 7px 0 3px 0; }
QPushButton#section:hover { color: @ink; }
QPushButton#section:focus { border: none; border-top: 2px solid @accent; padding: 6px 0 3px 0; }
QPushButton#toggle:checked { background: @picked; border-color: @accent; }
QFrame#tools { background: @panel; border: none; border-bottom: 1px solid @line; }
QFrame#tools QToolButton { border: 1px solid transparent; border-radius: 5px; padding: 3px 6px; }
QFrame#tools QToolButton:hover { border-color: @edge; background: @field; }
QFrame#tools QToolButton:checked { background: @accent; border-color: @accent; color: @on_accent; }
QFrame#tools QToolButton:checked:disabled { background: @accent_off; border-color: @accent_off; color: @accent_off_ink; }
QFrame#tools QToolButton:disabled { color: @off; }
QFrame#tools QToolButton:focus { border: 2px solid @accent_ring; padding: 2px 5px; }
QFrame#mode { background: @panel; border: 1px solid @line; border-radius: 7px; }
QFrame#nothing { background: @panel; border: 1px solid @line; border-radius: 7px; padding: 5px 10px; }
QFrame#nothing QLabel { background: transparent; color: @status; }
QLabel#reading { background: @panel; border: 1px solid @line; border-radius: 5px; padding: 4px 9px; color: @status; }
QTableWidget#sheet { background: @field; border: 1px solid @line; border-radius: 5px; padding: 4px 8px; }
QTableWidget#sheet::item { padding: 2px 0; }
QLineEdit { background: @field; border: 1px solid @edge; border-radius: 5px; padding: 4px 8px; }
QLineEdit:focus { border-color: @accent; }
QScrollArea#scroll { background: transparent; border: none; border-top: 1px solid @faint; padding-top: 6px; }
QWidget#scrolled { background: @panel; }
QScrollArea#panel_scroll { background: @panel; border: none; }
QWidget#handles { background: @panel; border-left: 1px solid @line; }
QFrame#strip { background: @panel; border: none; border-top: 1px solid @line; }
QComboBox { background: @field; border: 1px solid @edge; border-radius: 5px; padding: 4px 8px; }
QComboBox:hover { border-color: @edge_hover; }
QComboBox:focus { border-color: @accent; }
QComboBox:disabled { color: @off; background: @off_field; border-color: @off_edge; }
QComboBox::drop-down { border: none; width: 22px; }
QComboBox::down-arrow { image: url(:/bindpose/@down.png); width: 10px; height: 6px; }
QComboBox::down-arrow:disabled { image: url(:/bindpose/down-disabled.png); }
QComboBox QAbstractItemView { background: @field; selection-background-color: @chosen; selection-color: @ink; }
QCheckBox { spacing: 8px; }
QCheckBox::indicator { width: 14px; height: 14px; border: 1px solid @edge_hover; border-radius: 3px; background: @field; }
QCheckBox::indicator:hover { border-color: @accent; }
QCheckBox::indicator:focus { border: 1px solid @accent_ring; }
QCheckBox::indicator:checked { background: @accent; border-color: @accent; image: url(:/bindpose/check.png); }
QCheckBox::indicator:disabled { background: @off_field; border-color: @off_edge; }
QCheckBox::indicator:checked:disabled { background: @accent_off; border-color: @accent_off; }
QCheckBox:disabled { color: @off; }
QDoubleSpinBox { background: @field; border: 1px solid @edge; border-radius: 5px; padding: 3px 6px; }
QDoubleSpinBox:hover { border-color: @edge_hover; }
QDoubleSpinBox:focus { border-color: @accent; }
QDoubleSpinBox:disabled { color: @off; background: @off_field; border-color: @off_edge; }
QSlider::groove:horizontal { height: 4px; background: @line; border-radius: 2px; }
QSlider::sub-page:horizontal { background: @accent; border-radius: 2px; }
QSlider::sub-page:horizontal:disabled { background: @accent_off; }
QSlider::handle:horizontal { width: 14px; margin: -6px 0; border-radius: 8px; background: @field; border: 1px solid @edge_hover; }
QSlider::handle:horizontal:hover { border-color: @accent; }
QSlider::handle:horizontal:focus { border: 2px solid @accent_ring; }
QListWidget { background: @field; border: 1px solid @line; border-radius: 5px; outline: none; }
QListWidget:focus { border-color: @accent; }
QListWidget::item { padding: 4px 6px; border: none; }
QListWidget::item:hover { background: @item_hover; }
QListWidget::item:selected { background: @picked; color: @ink; }
QTreeWidget { background: @field; border: 1px solid @line; border-radius: 5px; outline: none; selection-background-color: @picked; selection-color: @ink; }
QTreeWidget:focus { border-color: @accent; }
QTreeWidget::item { padding: 2px 4px; border: none; }
QTreeWidget::item:hover { background: @item_hover; }
QTreeWidget::item:selected { background: @picked; color: @ink; }
QSplitter::handle { background: @panel; border-left: 1px solid @line; }
QSplitter::handle:hover { background: @menu_hover; }
QScrollBar:vertical { background: transparent; width: 10px; margin: 2px; }
QScrollBar:horizontal { background: transparent; height: 10px; margin: 2px; }
QScrollBar::handle { background: @scroll; border-radius: 3px; min-height: 24px; min-width: 24px; }
QScrollBar::handle:hover { background: @edge_hover; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QProgressBar { background: @trough; border: none; border-radius: 3px; max-height: 6px; }
QProgressBar::chunk { background: @accent; border-radius: 3px; }
QFrame#error { background: @error; border: 1px solid @error_edge; border-radius: 7px; }
QFrame#error QLabel { color: @error_ink; }
QFrame#error QPushButton { border: none; background: transparent; color: @error_ink; font-weight: 600; padding: 2px 8px; }
QFrame#notice { background: @notice; border: 1px solid @notice_edge; border-radius: 7px; }
QFrame#notice QLabel { color: @notice_ink; }
QFrame#notice QPushButton { padding: 3px 10px; }
QFrame#notice QPushButton:focus { padding: 2px 9px; }
QToolTip { background: @tip; color: @ink; border: 1px solid @tip_edge; padding: 3px; }
)";

const char* const appearance_key = "appearance";
const char* const appearance_words[] = { "system", "light", "dark" };
bool dark_now = false;

/// Report whether the desktop is dark. The first call computes the result from the application's
/// palette, so it must precede all changes of the palette.
bool system_is_dark(const QApplication& application)
{
  static const bool dark = application.palette().color(QPalette::Window).lightness() < 128;
  return dark;
}
} // namespace

QColor theme_color(const char* name)
{
  const auto* const found = std::find_if(std::begin(theme_colors), std::end(theme_colors),
    [name](const ThemeColor& each) { return std::string_view(each.name) == name; });
  return found == std::end(theme_colors) ? QColor() : QColor(dark_now ? found->dark : found->light);
}

bool is_dark()
{
  return dark_now;
}

Appearance chosen_appearance()
{
  const QString word = user_settings()->value(appearance_key).toString();
  const auto* const found =
    std::find(std::begin(appearance_words), std::end(appearance_words), word);
  return found == std::end(appearance_words)
    ? Appearance::system
    : static_cast<Appearance>(found - std::begin(appearance_words));
}

void choose_appearance(QApplication& application, Appearance appearance)
{
  user_settings()->setValue(appearance_key, appearance_words[static_cast<int>(appearance)]);
  apply_style(application);
}

void apply_style(QApplication& application)
{
  init_resources();
  const bool system_dark = system_is_dark(application);
  const Appearance chosen = chosen_appearance();
  dark_now = chosen == Appearance::dark || (chosen == Appearance::system && system_dark);
  application.setStyle(QStyleFactory::create("Fusion"));
  QPalette palette;
  const auto set = [&palette](QPalette::ColorRole role, const char* name, const char* off)
  {
    palette.setColor(role, theme_color(name));
    palette.setColor(QPalette::Disabled, role, theme_color(off));
  };
  set(QPalette::Window, "window", "window");
  set(QPalette::WindowText, "ink", "off");
  set(QPalette::Base, "field", "off_field");
  set(QPalette::AlternateBase, "alternate", "alternate");
  set(QPalette::Text, "ink", "off");
  set(QPalette::Button, "field", "off_field");
  set(QPalette::ButtonText, "ink", "off");
  set(QPalette::Highlight, "accent", "accent_off");
  set(QPalette::HighlightedText, "on_accent", "accent_off_ink");
  set(QPalette::ToolTipBase, "tip", "tip");
  set(QPalette::ToolTipText, "ink", "ink");
  set(QPalette::Link, "accent", "off");
  application.setPalette(palette);
  QFont font = application.font();
  font.setPointSizeF(10.0);
  application.setFont(font);
  QString text = sheet;
  // Sort the names by descending length, because one name may be a prefix of another name.
  std::vector<ThemeColor> by_length(std::begin(theme_colors), std::end(theme_colors));
  std::sort(by_length.begin(), by_length.end(),
    [](const ThemeColor& a, const ThemeColor& b)
    { return std::string_view(a.name).size() > std::string_view(b.name).size(); });
  for (const ThemeColor& each : by_length)
  {
    text.replace(QString("@") + each.name, theme_color(each.name).name());
  }
  text.replace("@down", dark_now ? "down-light" : "down");
  application.setStyleSheet(text);
}

} // namespace app::parts
