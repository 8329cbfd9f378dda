// TGF (trivial graph format): nodes and edges survive the round trip, and errors name their line.
#include "io/tgf.h"

#include "support/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
class TgfFiles : public testing::Test
{
protected:
  std::string error(const std::string& text)
  {
    return read_tgf(this->folder.write("h.tgf", text), this->graph).message;
  }
  test::Folder folder;
  Tgf graph;
};
} // namespace

TEST_F(TgfFiles, NodesAndEdges)
{
  ASSERT_EQ(this->error("1 0 0 0\n2 1.5 -2e-1 0 left hand\n10 1 1 1\n#\n1 2 1 0 0\n2 10\n"
                        "1 10 0 1 0\n# \nignored\n"),
    "");
  ASSERT_EQ(this->graph.nodes.size(), 3u);
  EXPECT_EQ(this->graph.nodes[1].position, Vec3(1.5, -0.2, 0));
  EXPECT_EQ(this->graph.nodes[1].text, "left hand");
  ASSERT_EQ(this->graph.edges.size(), 3u);
  EXPECT_EQ(this->graph.edges[1].to, 2);
  EXPECT_TRUE(this->graph.edges[1].bone);
  EXPECT_FALSE(this->graph.edges[2].bone);
  EXPECT_TRUE(this->graph.edges[2].pseudo);

  ASSERT_TRUE(write_tgf(this->folder / "again.tgf", this->graph).ok());
  Tgf again;
  ASSERT_TRUE(read_tgf(this->folder / "again.tgf", again).ok());
  EXPECT_EQ(again.nodes[1].text, "left hand");
  EXPECT_EQ(again.nodes[1].position, this->graph.nodes[1].position);
  EXPECT_EQ(again.edges[2].from, 0);
  EXPECT_TRUE(again.edges[2].pseudo);
}

TEST_F(TgfFiles, ErrorsNameTheLine)
{
  EXPECT_THAT(
    this->error("1 0 0 0\n1 0 0 1\n"), HasSubstr("h.tgf, line 2: node 1 is defined twice"));
  EXPECT_THAT(
    this->error("1 0 0\n"), HasSubstr("line 1: node 1 must have three numbers as coordinates"));
  EXPECT_THAT(this->error("1 0 nan 0\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(this->error("a 0 0 0\n"), HasSubstr("line 1"));
  EXPECT_THAT(
    this->error("1 0 0 0\n2 1 0 0\n#\n1 3\n"), HasSubstr("line 4: an edge references node 3"));
  EXPECT_THAT(this->error("1 0 0 0\n#\n1 1\n"), HasSubstr("must connect two different nodes"));
  EXPECT_THAT(this->error("1 0 0 0\n2 1 0 0\n#\n1\n"), HasSubstr("line 4"));
  EXPECT_THAT(this->error("1 0 0 0\n2 1 0 0\n#\n1 2 yes\n"), HasSubstr("flags"));
  EXPECT_THAT(this->error("#\n"), HasSubstr("no node"));
  EXPECT_THAT(this->error(""), HasSubstr("is empty"));
  EXPECT_TRUE(this->graph.nodes.empty());
}

TEST(TgfTexts, AreReadBackWithoutAFile)
{
  Tgf graph;
  const std::string text = "1 0 0.1 -1e-300 left hand\n2 1 0 0\n3 1 1 0\n4 0 1 0\n#\n"
                           "1 2 1 0 0\n2 3 0 1 0\n4 3 0 0 1\n";
  ASSERT_TRUE(parse_tgf(text, graph).ok());
  ASSERT_EQ(graph.nodes.size(), 4u);
  ASSERT_EQ(graph.edges.size(), 3u);
  EXPECT_TRUE(graph.edges[2].cage);
  EXPECT_EQ(graph.nodes[3].line, 4);
  EXPECT_EQ(graph.edges[0].line, 6);
  EXPECT_EQ(format_tgf(graph), text);
  // The writer renumbers the nodes. The parser accepts line ends CR LF and a missing last line end.
  ASSERT_TRUE(parse_tgf("7 0 0 0\r\n-3 1 0 0 tip\r\n#\r\n7 -3", graph).ok());
  EXPECT_EQ(graph.nodes[1].text, "tip");
  EXPECT_EQ(format_tgf(graph), "1 0 0 0\n2 1 0 0 tip\n#\n1 2 1 0 0\n");
}

TEST(TgfTexts, ErrorsNameTheLineOnly)
{
  Tgf graph;
  EXPECT_EQ(parse_tgf("1 0 0 0\n1 0 0 1\n", graph).message, "line 2: node 1 is defined twice");
  EXPECT_TRUE(graph.nodes.empty());
  EXPECT_EQ(parse_tgf("", graph).message, "there are no nodes");
  EXPECT_EQ(parse_tgf("#\n", graph).message, "line 1: there are no nodes");
}
