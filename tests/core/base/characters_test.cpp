#include "core/base/characters.h"

#include <gtest/gtest.h>

namespace runnel {
namespace {

TEST(Characters, AreCounted) {
  EXPECT_EQ(CharacterCount(""), 0U);
  EXPECT_EQ(CharacterCount("a€b"), 3U);
}

TEST(Characters, AreNotCutInTwo) {
  EXPECT_EQ(WholeCharacters("abc", 2), 2U);
  EXPECT_EQ(WholeCharacters("abc", 3), 3U);
  EXPECT_EQ(WholeCharacters("a€", 2), 1U);
  EXPECT_EQ(WholeCharacters("a€", 3), 1U);
  EXPECT_EQ(WholeCharacters("a€", 4), 4U);
  EXPECT_EQ(WholeCharacters("\x80\x80\x80\x80\x80\x80", 4), 4U) << "no character at all";
  EXPECT_EQ(Shortened("a€", 4), "a€");
  EXPECT_EQ(Shortened("a€", 3), "a…");
}

// What others have written can neither move a cursor nor begin a line of its own.
TEST(Characters, AreShownAndNotObeyedByTerminals) {
  EXPECT_EQ(Printable("a planner, 20 °C €"), "a planner, 20 °C €");
  EXPECT_EQ(Printable("evil \x1b[31m\n12.0s error"), "evil \\x1b[31m\\x0a12.0s error");
  EXPECT_EQ(Printable("a\r\x7f\xff\xc2\x9b"
                      "31m",
                      "\n"),
            "a\\x0d\\x7f\\xff\\xc2\\x9b31m");
  EXPECT_EQ(Printable("two\nlines\t.", "\n\t"), "two\nlines\t.");
  EXPECT_EQ(Printable("\xe2\x82"), "\\xe2\\x82") << "cut in two";
}

TEST(Characters, AreQuotedAsInCpp) {
  EXPECT_EQ(Quoted(""), "\"\"");
  EXPECT_EQ(Quoted("a\"b\\\n\t\r€"), R"("a\"b\\\n\t\r€")");
}

}  // namespace
}  // namespace runnel
