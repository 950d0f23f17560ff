#include "plugins/inspector/inspector_place.h"

#include <gmock/gmock.h>

#include "plugins/inspector/element_json.h"

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
  for (const char* text : {"", "x", "-1", "65536", "80 ", ":80", "0.0.0.0", "0.0.0.0:", "here:80",
                           "127.0.0.1:x", "1.2.3:80"}) {
    const auto place = ParseInspectorPlace(text);
    ASSERT_FALSE(place) << text;
    EXPECT_NE(place.error().hint, "") << text;
  }
}

TEST(Bounds, AreReadFromWhatParametersSayOfThem) {
  const auto both = internal::ParseBounds("0.05 .. 5");
  EXPECT_EQ(both.minimum, 0.05);
  EXPECT_EQ(both.maximum, 5);
  EXPECT_EQ(internal::ParseBounds("-1 ..").minimum, -1);
  EXPECT_EQ(internal::ParseBounds("-1 ..").maximum, std::nullopt);
  EXPECT_EQ(internal::ParseBounds(".. 7").minimum, std::nullopt);
  EXPECT_EQ(internal::ParseBounds(".. 7").maximum, 7);
  EXPECT_EQ(internal::ParseBounds("").maximum, std::nullopt);
}

}  // namespace

}  // namespace runnel::test
