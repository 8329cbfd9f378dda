#ifndef bindpose_tests_viewer_app_unclipped_h
#define bindpose_tests_viewer_app_unclipped_h

// Tests that no text is clipped: the child widgets of a widget have the space that their texts
// need.

#include <QComboBox>
#include <QPushButton>
#include <QStyle>
#include <QStyleOptionComboBox>
#include <QWidget>

#include <gtest/gtest.h>

namespace bindpose::test
{

/// Check the visible buttons.
inline void expect_unclipped_buttons(const QWidget* parent)
{
  for (const QPushButton* button : parent->findChildren<QPushButton*>())
  {
    if (button->isVisible())
    {
      EXPECT_LE(button->sizeHint().width(), button->width()) << button->text().toStdString();
      EXPECT_LE(button->sizeHint().height(), button->height()) << button->text().toStdString();
    }
  }
}

/// Check the visible combo boxes: each item must fit when it is chosen.
inline void expect_unclipped_items(const QWidget* parent)
{
  for (const QComboBox* box : parent->findChildren<QComboBox*>())
  {
    if (!box->isVisible())
    {
      continue; // hidden boxes have no layout
    }
    QStyleOptionComboBox option;
    option.initFrom(box);
    option.editable = false;
    const int available_width =
      box->style()
        ->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, box)
        .width();
    for (int item = 0; item < box->count(); ++item)
    {
      EXPECT_LE(box->fontMetrics().horizontalAdvance(box->itemText(item)), available_width)
        << box->itemText(item).toStdString();
    }
  }
}

} // namespace bindpose::test

#endif
