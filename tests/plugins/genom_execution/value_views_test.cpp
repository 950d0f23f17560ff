// Lists of codels in C, as their module copies and destroys them.

#include "plugins/genom_execution/value_views.h"

#include <gtest/gtest.h>

namespace runnel::genom_execution {
namespace {

// As codels take an element out: they give back what it has, move the others by their bytes, and lower the length.
template <typename List>
void TakesOut() {
  List list;
  ASSERT_TRUE(list.Resize(2));
  list.buffer[0].Set("first");
  list.buffer[1].Set("second");
  std::free(list.buffer[0].text);
  list.buffer[0].text = list.buffer[1].text;
  list.length = 1;
  const List copy = list;
  ASSERT_EQ(copy.length, 1u);
  EXPECT_EQ(copy.buffer[0].view(), "second");
  ASSERT_TRUE(list.Resize(2));
  EXPECT_EQ(list.buffer[1].view(), "") << "a new one is empty";
  EXPECT_EQ(list.buffer[0].view(), "second");
  list.buffer[1].Set("third");
  ASSERT_TRUE(list.Resize(1));
  ASSERT_TRUE(list.Resize(3));
  EXPECT_EQ(list.buffer[0].view(), "second");
  EXPECT_EQ(list.buffer[1].view(), "");
  EXPECT_EQ(list.buffer[2].view(), "");
  list.length = 0;
  std::free(list.buffer[0].text);
}

TEST(ValueViews, AListOwnsNothingBeyondItsLength) {
  TakesOut<OwnedList<OwnedText>>();
  TakesOut<BoundedList<OwnedText, 3>>();
}

}  // namespace
}  // namespace runnel::genom_execution
