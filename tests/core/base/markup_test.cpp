#include <gtest/gtest.h>

#include "core/base/characters.h"

namespace runnel {
namespace {

TEST(EscapedMarkup, TextStandsForItself) {
  EXPECT_EQ(EscapedMarkup(""), "");
  EXPECT_EQ(EscapedMarkup("Umläute, 'quotes' and\nlines"), "Umläute, 'quotes' and\nlines");
}

TEST(EscapedMarkup, WhatWouldBeReadAsMarkupIsEscapedOnce) {
  EXPECT_EQ(EscapedMarkup(R"(<b a="1">&lt;</b>)"), "&lt;b a=&quot;1&quot;&gt;&amp;lt;&lt;/b&gt;");
}

}  // namespace
}  // namespace runnel
