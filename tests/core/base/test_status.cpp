// Reports: named entries and their conversion to JSON. Status: each message is one line of UTF-8.
#include "base/status.h"
#include "io/report_json.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

TEST(Report, KeepsOrderAndReplacesInPlace)
{
  Report report;
  report.set("b", 1);
  report.set("a", 2);
  report.set("b", 3);
  ASSERT_EQ(report.entries().size(), 2u);
  EXPECT_EQ(report.entries()[0].first, "b");
  EXPECT_EQ(report.number("b", 0), 3.0);
  report.add("a", 0.5);
  EXPECT_EQ(report.number("a", 0), 2.5);
  report.erase("b");
  EXPECT_EQ(report.find("b"), nullptr);
  EXPECT_EQ(report.text("a", "none"), "none");
}

TEST(Report, NumbersKeepTheirKind)
{
  Report report;
  report.set("seconds", 0.25);
  report.set("count", std::size_t(7));
  report.set("huge", std::int64_t(1) << 40);
  EXPECT_EQ(report.number("seconds", 0), 0.25);
  EXPECT_EQ(std::get<std::int64_t>(*report.find("count")), 7);
  EXPECT_EQ(std::get<std::int64_t>(*report.find("huge")), std::int64_t(1) << 40);
}

TEST(Report, BecomesNestedJson)
{
  Report report;
  report.set("status", "ok");
  report.set("counts.vertices", 8);
  report.set("counts.triangles", 12);
  report.set("handles[].name", Report::Value(std::vector<std::string>{ "a", "b\"" }));
  report.set("handles[].constrained_vertices", Report::Value(std::vector<std::int64_t>{ 1, 5 }));
  report.set("warnings[]", Report::Value(std::vector<std::string>{ "one" }));
  report.set("bad", Report::Value(std::nan("")));
  EXPECT_EQ(to_json(report, -1),
    R"({"status":"ok","counts":{"vertices":8,"triangles":12},)"
    R"("handles":[{"name":"a","constrained_vertices":1},{"name":"b\"","constrained_vertices":5}],)"
    R"("warnings":["one"]})");
}

TEST(Status, MessagesAreOneLineOfUtf8)
{
  EXPECT_EQ(Status::invalid_input("a\nb\r\x1b\x7f").message, "a?b???");
  EXPECT_EQ(sanitize_line("gr\xc3\xbc\xc3\x9f\xe2\x80\xa6 \xf0\x9f\x98\x80"),
    "gr\xc3\xbc\xc3\x9f\xe2\x80\xa6 \xf0\x9f\x98\x80");
  // The invalid sequences are: a truncated one, an overlong one, a surrogate, a code point above
  // the largest one, and a byte that cannot begin a sequence.
  EXPECT_EQ(sanitize_line("\xc3"), "?");
  EXPECT_EQ(sanitize_line("\xe0\x80\x80x"), "???x");
  EXPECT_EQ(sanitize_line("\xed\xa0\x80"), "???");
  EXPECT_EQ(sanitize_line("\xf4\x90\x80\x80"), "????");
  EXPECT_EQ(sanitize_line("\x80\xff" + std::string(1, '\0')), "???");
}

TEST(Status, UsableMeansThereIsAResult)
{
  EXPECT_TRUE(Status().usable());
  EXPECT_TRUE(Status::failure(StatusCode::not_converged, "x").usable());
  EXPECT_FALSE(Status::failure(StatusCode::not_converged, "x").ok());
  EXPECT_FALSE(Status::canceled().usable());
  EXPECT_STREQ(to_string(StatusCode::not_converged), "not_converged");
}
