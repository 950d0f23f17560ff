#include <gmock/gmock.h>

#include "plugins/inspector/xml_inspector_tag.h"

namespace runnel::test {

namespace {

using ::testing::HasSubstr;

TEST(InspectorPlace, IsReadWithAndWithoutAnAddress) {
  const auto port = ParseInspectorPlace("9000");
  ASSERT_TRUE(port);
  EXPECT_EQ(port->address, "127.0.0.1");
  EXPECT_EQ(port->port, 9000);
  const auto all = ParseInspectorPlace("0.0.0.0:0");
  ASSERT_TRUE(all);
  EXPECT_EQ(all->address, "0.0.0.0");
  EXPECT_EQ(all->port, 0);
  const auto six = ParseInspectorPlace("[::1]:80");
  ASSERT_TRUE(six);
  EXPECT_EQ(six->address, "::1");
  EXPECT_EQ(ParseInspectorPlace("localhost:80")->address, "127.0.0.1");
}

TEST(InspectorPlace, WhatIsNoneIsRefusedWithACure) {
  for (const char* text :
       {"", "x", "-1", "65536", "80 ", ":80", "0.0.0.0", "0.0.0.0:", "here:80", "127.0.0.1:x", "1.2.3:80"}) {
    const auto place = ParseInspectorPlace(text);
    ASSERT_FALSE(place) << text;
    EXPECT_NE(place.error().hint, "") << text;
  }
}

}  // namespace

}  // namespace runnel::test
