// Lists of codels in C, as their module copies and destroys them.

#include "plugins/genom_execution/value_views.h"

#include <algorithm>
#include <type_traits>

#include <gtest/gtest.h>

namespace runnel::genom_execution {
namespace {

// As codels take an element out: they give back what it has, move the others by their bytes, and lower the length.
template <typename List>
void TakeTheFirstOut() {
  List list;
  ASSERT_TRUE(list.Resize(2));
  list.buffer[0].Set("first");
  list.buffer[1].Set("second");
  std::free(list.buffer[0].text);
  list.buffer[0].text = list.buffer[1].text;
  list.length = 1;
  const List copy = list;
  EXPECT_EQ(copy.length, 1u);
  List assigned;
  ASSERT_TRUE(assigned.Resize(3));
  assigned.buffer[2].Set("old");
  assigned = list;
  EXPECT_EQ(assigned.length, 1u);
  EXPECT_EQ(assigned.buffer[0].view(), "second");
  ASSERT_TRUE(list.Resize(2));
  EXPECT_EQ(list.buffer[1].view(), "") << "a new one is empty";
  EXPECT_EQ(list.buffer[0].view(), "second");
  list.buffer[1].Set("third");
  ASSERT_TRUE(list.Resize(1));
  ASSERT_TRUE(list.Resize(3));
  EXPECT_EQ(list.buffer[0].view(), "second");
  EXPECT_EQ(list.buffer[1].view(), "");
  EXPECT_EQ(list.buffer[2].view(), "");
  // Taken out, and kept by nobody: whoever destroys the list must not look at it.
  std::free(list.buffer[0].text);
  list.length = 0;
}

TEST(ValueViews, AListOwnsNothingBeyondItsLength) { TakeTheFirstOut<OwnedList<OwnedText>>(); }
TEST(ValueViews, AListInPlaceOwnsNothingBeyondItsLength) { TakeTheFirstOut<BoundedList<OwnedText, 3>>(); }

// A codel in C raises the length, and looks how many each of the new ones may have.
TEST(ValueViews, ElementsBeyondTheLengthOfAListInPlaceKnowTheirBounds) {
  using Inner = BoundedList<OwnedText, 2>;
  BoundedList<Inner, 3> list;
  const auto know = [&] {
    return std::ranges::all_of(list.buffer, [](const Inner& each) { return each.maximum == 2; });
  };
  EXPECT_TRUE(know());
  ASSERT_TRUE(list.Resize(3));
  ASSERT_TRUE(list.buffer[2].Resize(1));
  list.buffer[2].buffer[0].Set("text");
  ASSERT_TRUE(list.Resize(1));
  EXPECT_TRUE(know());
  EXPECT_EQ(list.buffer[2].length, 0u);
  ASSERT_TRUE(list.Resize(3));
  list = BoundedList<Inner, 3>();
  EXPECT_TRUE(know());
}

TEST(ValueViews, AListOfWhatOwnsNothingIsCopiedByItsBytes) {
  static_assert(std::is_trivially_copyable_v<BoundedList<double, 4>>);
  static_assert(sizeof(BoundedList<OwnedText, 3>) == 8 + 3 * sizeof(char*));
}

}  // namespace
}  // namespace runnel::genom_execution
