// Tours (scripted demonstrations of the window) as text: the parsed content, and the error messages
// for invalid texts.
#include "app/tour/tour.h"

#include "support/files.h"

#include <gtest/gtest.h>

#include <random>

using namespace bindpose;

namespace
{
std::string with_steps(const std::string& steps)
{
  return R"({"tour": {"schema": 1}, "steps": [)" + steps + "]}";
}

Status parse_steps(const std::string& steps, app::tour::Tour& tour)
{
  return app::tour::parse_tour(with_steps(steps), tour);
}

/// Return the error message for a tour with these steps.
std::string refusal(const std::string& steps)
{
  app::tour::Tour tour;
  const Status status = parse_steps(steps, tour);
  EXPECT_EQ(status.code, StatusCode::invalid_input) << steps;
  EXPECT_EQ(status.message.find('\n'), std::string::npos);
  return status.message;
}
} // namespace

TEST(Tour, EveryVerbIsRead)
{
  app::tour::Tour tour;
  const Status status = app::tour::parse_tour(R"({
    "tour": {"schema": 1, "name": "all", "size": [900, 600], "seconds": 12.5},
    "steps": [
      {"open": "a.off", "say": "Open it."},
      {"action": "edit.bind"},
      {"push": "Compare"},
      {"option": "tets.shrink", "value": 0.5},
      {"option": "weights.bands", "value": false},
      {"panel": "weights"},
      {"select": "top"},
      {"click": [0.25, 0.75], "button": "right", "held": ["shift", "ctrl"]},
      {"double_click": {"handle": "top"}},
      {"press": {"handle": "b1", "along": 1, "offset": [3, -4]}},
      {"move": [0.5, 0.5], "held": "alt"},
      {"release": [1, 1], "button": "middle"},
      {"drag": {"handle": "top"}, "to": [0.1, 0.2], "moves": 3},
      {"wheel": [0.5, 0.5], "turns": -2},
      {"key": "Ctrl+Z"}, {"scrub": 0.75},
      {"resize": [1000, 700]},
      {"wait": "bind"}, {"wait": "idle"}, {"wait": 0.25},
      {"film": "turn", "of": "view", "width": 400}, {"film": "end"},
      {"screenshot": "one", "of": "view"}, {"screenshot": "two", "width": 320},
      {"mode": "free"},
      {"check": "energy", "is": 0.5, "tolerance": 1e-3},
      {"check": "handle.top", "is": [0, 1, 2]},
      {"check": "undo", "is": "bind"},
      {"check": "bound", "is": true},
      {"check": "steps", "at_least": 2}, {"check": "steps", "at_most": 5},
      {"check": "handle.top", "as_at": "one"}
    ]})",
    tour);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(tour.name, "all");
  EXPECT_EQ(tour.size, (std::array<int, 2>{ 900, 600 }));
  EXPECT_EQ(tour.seconds, 12.5);
  ASSERT_EQ(tour.steps.size(), 32u);
  const auto& s = tour.steps;
  EXPECT_EQ(s[0].text, "a.off");
  EXPECT_EQ(s[0].narration, "Open it.");
  EXPECT_EQ(s[3].expected, std::vector<double>{ 0.5 });
  EXPECT_TRUE(s[4].expects_bool);
  EXPECT_EQ(s[4].expected, std::vector<double>{ 0.0 });
  EXPECT_EQ(s[7].button, app::tour::TourButton::right);
  EXPECT_TRUE(s[7].shift && s[7].ctrl && !s[7].alt);
  EXPECT_EQ(s[7].mouse_position.position, (std::array<double, 2>{ 0.25, 0.75 }));
  EXPECT_EQ(s[8].mouse_position.handle, "top");
  EXPECT_EQ(s[9].mouse_position.bone_fraction, 1.0);
  EXPECT_EQ(s[9].mouse_position.position, (std::array<double, 2>{ 3, -4 }));
  EXPECT_TRUE(s[10].alt);
  EXPECT_EQ(s[12].to.position, (std::array<double, 2>{ 0.1, 0.2 }));
  EXPECT_EQ(s[12].moves, 3);
  EXPECT_EQ(s[13].turns, -2.0);
  EXPECT_EQ(s[15].seconds, 0.75);
  EXPECT_EQ(s[16].size, (std::array<int, 2>{ 1000, 700 }));
  EXPECT_EQ(s[17].text, "bind");
  EXPECT_EQ(s[19].seconds, 0.25);
  EXPECT_EQ(s[20].part, app::tour::TourPart::view);
  EXPECT_EQ(s[23].width, 320);
  EXPECT_EQ(s[23].part, app::tour::TourPart::window);
  EXPECT_EQ(s[24].text, "free");
  EXPECT_EQ(s[25].tolerance, 1e-3);
  EXPECT_EQ(s[26].expected.size(), 3u);
  EXPECT_TRUE(s[27].expects_text);
  EXPECT_EQ(s[29].relation, app::tour::TourRelation::at_least);
  EXPECT_EQ(s[31].relation, app::tour::TourRelation::as_at);
  for (const app::tour::TourStep& step : s)
  {
    EXPECT_NE(to_string(step.verb), nullptr);
  }
}

TEST(Tour, AMistakeIsOneSentenceThatNamesTheStep)
{
  EXPECT_EQ(refusal(R"({"opne": "a"})"), "step 1 must have a verb: \"opne\" is not a verb");
  EXPECT_EQ(refusal(R"({"wait": 1}, 7)"), "step 2 must be a JSON object");
  EXPECT_EQ(refusal("{}"), "step 1 is empty");
  EXPECT_EQ(refusal(R"({"open": "a", "key": "B"})"), "step 1 has two verbs, \"open\" and \"key\"");
  EXPECT_EQ(
    refusal(R"({"open": 3})"), "step 1 (open): the value of the verb must be a nonempty string");
  EXPECT_EQ(refusal(R"({"open": "a", "button": "left"})"),
    "step 1 (open): the verb cannot have the field \"button\"");
  EXPECT_EQ(refusal(R"({"wait": 0}, {"wait": "lunch"})"),
    "step 2 (wait): expected \"bind\", \"idle\" or 0 to 3600 seconds");
  EXPECT_EQ(refusal(R"({"click": [1]})"),
    "step 1 (click): a position must be two fractions of the view size, for example [0.5, 0.5]");
  EXPECT_EQ(refusal(R"({"click": {"handle": "a", "of": 1}})"),
    "step 1 (click): a position cannot have the field \"of\"");
  EXPECT_EQ(
    refusal(R"({"click": {"gizmo": "move_w"}})"), "step 1 (click): unknown gizmo part \"move_w\"");
  EXPECT_EQ(refusal(R"({"click": {"gizmo": "move_x", "along": 1}})"),
    "step 1 (click): a position cannot have the field \"along\"");
  EXPECT_EQ(refusal(R"({"click": [0, 0], "button": "fourth"})"),
    "step 1 (click): \"button\" must be one of left, middle, right");
  EXPECT_EQ(refusal(R"({"click": [0, 0], "held": "hat"})"),
    "step 1 (click): \"held\" must be shift, ctrl or alt, or a list of these");
  EXPECT_EQ(refusal(R"({"drag": [0, 0]})"), "step 1 (drag): \"to\" is missing");
  EXPECT_EQ(refusal(R"({"drag": [0, 0], "to": [1, 1], "moves": 0})"),
    "step 1 (drag): \"moves\" must be a number from 1 to 1000");
  EXPECT_EQ(refusal(R"({"wheel": [0, 0]})"), "step 1 (wheel): \"turns\" is missing");
  EXPECT_EQ(refusal(R"({"type": "5"})"), "step 1 (type): \"into\" is missing");
  EXPECT_EQ(refusal(R"({"push": "Open", "answer": "../a.ply"})"),
    "step 1 (push): the answer must be 1 to 60 letters, digits, '_', '-' and '.', and must not "
    "start with '.'");
  EXPECT_EQ(refusal(R"({"key": "K", "answer": "a.ply"})"),
    "step 1 (key): the verb cannot have the field \"answer\"");
  EXPECT_EQ(refusal(R"({"option": "a"})"), "step 1 (option): \"value\" is missing");
  EXPECT_EQ(refusal(R"({"check": "a"})"),
    "step 1 (check): a check must have exactly one of \"is\", \"at_least\", \"at_most\", "
    "\"as_at\"");
  EXPECT_EQ(refusal(R"({"check": "a", "is": 1, "at_most": 2})"),
    "step 1 (check): a check must have exactly one of \"is\", \"at_least\", \"at_most\", "
    "\"as_at\"");
  EXPECT_EQ(refusal(R"({"check": "a", "at_least": "many"})"),
    "step 1 (check): \"at_least\" and \"at_most\" must be numbers");
  EXPECT_EQ(refusal(R"({"check": "a", "as_at": "start"})"),
    "step 1 (check): no earlier screenshot is named \"start\"");
  EXPECT_EQ(refusal(R"({"screenshot": "a/b"})"),
    "step 1 (screenshot): a name must be 1 to 60 letters, digits, '_', '-' and '.', and must not "
    "start with '.'");
  EXPECT_EQ(refusal(R"({"screenshot": "a"}, {"screenshot": "a"})"),
    "step 2 (screenshot): the name \"a\" is already used by an earlier step");
  EXPECT_EQ(
    refusal(R"({"film": "a"})"), "the last film must end: add the step {\"film\": \"end\"}");
  EXPECT_EQ(refusal(R"({"film": "end"})"), "step 1 (film): no film was started");
  EXPECT_EQ(refusal(R"({"resize": [10, 10]})"),
    "step 1 (resize): a size must be two numbers from 200 to 8000");
  EXPECT_EQ(refusal(""), "\"steps\" must be a list of 1 to 10000 steps");
}

TEST(Tour, AnotherFileIsRefused)
{
  app::tour::Tour tour;
  EXPECT_EQ(app::tour::parse_tour("no JSON", tour).message, "expected a JSON object");
  EXPECT_EQ(app::tour::parse_tour("[1]", tour).message, "expected a JSON object");
  EXPECT_EQ(app::tour::parse_tour(R"({"steps": []})", tour).message,
    "expected a tour: {\"tour\": {\"schema\": 1}, \"steps\": […]}");
  EXPECT_EQ(app::tour::parse_tour(R"({"tour": {"schema": 2}, "steps": []})", tour).message,
    "the schema of the tour is 2; expected 1");
  EXPECT_EQ(
    app::tour::parse_tour(R"({"tour": {"schema": 1, "speed": 2}, "steps": []})", tour).message,
    "the object \"tour\" cannot have the field \"speed\"");
  EXPECT_EQ(app::tour::parse_tour(
              R"({"tour": {"schema": 1, "view": [760, 10]}, "steps": [{"wait": 0}]})", tour)
              .message,
    "the object \"tour\": a size must be two numbers from 200 to 8000");
  ASSERT_TRUE(app::tour::parse_tour(
    R"({"tour": {"schema": 1, "view": [760, 560]}, "steps": [{"wait": 0}]})", tour)
                .ok());
  EXPECT_EQ(tour.view, (std::array<int, 2>{ 760, 560 }));
  EXPECT_EQ(app::tour::parse_tour(R"({"tour": {"schema": 1}, "stops": []})", tour).message,
    "a tour cannot have the field \"stops\"");
  EXPECT_EQ(
    app::tour::read_tour("/no/such.json", tour).message, "tour '/no/such.json' cannot be read");

  const test::Folder folder;
  const std::string bad = folder.write("bad.json", with_steps(R"({"wait": "x"})"));
  EXPECT_EQ(
    app::tour::read_tour(bad, tour).message.find("tour '" + bad + "': step 1 (wait): "), 0u);
  ASSERT_TRUE(
    app::tour::read_tour(folder.write("walk.json", with_steps(R"({"wait": 0})")), tour).ok());
  EXPECT_EQ(tour.name, "walk"); // without a name in the text, the name of the file is used
}

/// A file with any content is either read or refused with one sentence.
TEST(Tour, BrokenTextsNeverCrash)
{
  const std::string valid_text = with_steps(
    R"({"open": "a.off"}, {"drag": {"handle": "top", "offset": [1, 2]}, "to": [0.1, 0.2], "moves": 3},
       {"screenshot": "one"}, {"check": "x", "as_at": "one", "tolerance": 0.1})");
  std::mt19937 random(7);
  app::tour::Tour tour;
  ASSERT_TRUE(app::tour::parse_tour(valid_text, tour).ok());
  int refused = 0;
  for (int round = 0; round < 20000; ++round)
  {
    std::string text = valid_text;
    for (int change = 0; change < 1 + static_cast<int>(random() % 4); ++change)
    {
      const std::size_t position = random() % text.size();
      const char random_characters[] = "{}[]\",:0129.eE-tfn\\\xff";
      random() % 3 == 0 ? text.erase(position, 1 + random() % 8)
                        : text.replace(position, 1, 1,
                            random_characters[random() % (sizeof(random_characters) - 1)]);
    }
    const Status status = app::tour::parse_tour(text, tour);
    refused += !status.ok();
    EXPECT_TRUE(status.ok() || !status.message.empty());
  }
  EXPECT_GT(refused, 10000);
}
