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

TEST(Characters, AreQuotedAsInCpp) {
  EXPECT_EQ(Quoted(""), "\"\"");
  EXPECT_EQ(Quoted("a\"b\\\n\t\r€"), R"("a\"b\\\n\t\r€")");
}

}  // namespace
}  // namespace runnel
