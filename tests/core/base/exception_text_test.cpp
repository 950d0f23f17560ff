#include <new>
#include <stdexcept>

#include <gmock/gmock.h>

#include "core/base/check.h"
#include "core/base/error.h"

namespace runnel {
namespace {

template <typename Thrown>
std::string SaidOf(Thrown thrown) {
  try {
    throw thrown;
  } catch (...) {
    return DescribeException();
  }
}

struct Unusual {};

TEST(ExceptionText, IsWhatAStandardExceptionSays) {
  EXPECT_EQ(SaidOf(std::runtime_error("no such device")), "no such device");
  EXPECT_EQ(SaidOf(ProgrammingError("asked too early")), "asked too early");
}

TEST(ExceptionText, IsTheTextThatWasThrown) {
  EXPECT_EQ(SaidOf(std::string("as a string")), "as a string");
  EXPECT_EQ(SaidOf("as characters"), "as characters");
}

TEST(ExceptionText, NamesTheTypeOfWhatSaysNothing) {
  EXPECT_EQ(SaidOf(1), "exception of type int");
  EXPECT_THAT(SaidOf(Unusual{}), ::testing::HasSubstr("Unusual"));
}

TEST(ExceptionText, DoesNotReadThroughANullPointer) {
  EXPECT_EQ(SaidOf(static_cast<const char*>(nullptr)), "null pointer");
}

TEST(ExceptionText, CanBeAskedLaterAndByAnotherFunction) {
  std::exception_ptr kept;
  try {
    throw 1.5;
  } catch (...) {
    kept = std::current_exception();
  }
  EXPECT_EQ(DescribeException(kept), "exception of type double");
}

TEST(ExceptionText, SaysThatThereIsNone) { EXPECT_EQ(DescribeException(), "no exception"); }

}  // namespace
}  // namespace runnel
