// Arguments and replies as requests and responses, and what others may send instead.
#include "plugins/ros_services/service_form.h"

#include <cstring>

#include <gmock/gmock.h>

#include "core/types/type_of.h"
#include "modules/types/pose.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_services/service_endpoints.h"
#include "plugins/services/service_signature.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const MessageLibrary& Messages() { return MessageLibrary::Standard(); }

std::shared_ptr<const ServiceForm> Make(const TypeInfo* arguments, const TypeInfo* reply, const std::string& as = "") {
  auto made = ServiceForm::Make(arguments, reply, as, Messages());
  if (!made) throw std::runtime_error(made.error().ToString());
  return *made;
}

std::string WhyNot(const TypeInfo* arguments, const TypeInfo* reply, const std::string& as) {
  const auto made = ServiceForm::Make(arguments, reply, as, Messages());
  return made ? "" : made.error().ToString();
}

TEST(ServiceFormTest, AStructureComesBackWithWhetherItIsThere) {
  const ArgumentType<std::string, int> arguments({"name", "times"});
  const auto form = Make(arguments.Get(), &TypeOf<Pose2>());
  EXPECT_EQ(form->ros_type(), "runnel_msgs/srv/Pose2StringInt32");
  Octets octets;
  ArgumentPack<std::string, int> asked, heard;
  WithArguments<std::string, int>(asked, [](std::string& name, int& times) {
    name = "dock";
    times = -3;
  });
  form->WriteRequest(&asked, octets);
  ASSERT_TRUE(form->ReadRequest(octets, &heard));
  WithArguments<std::string, int>(heard, [](const std::string& name, int times) {
    EXPECT_EQ(name, "dock");
    EXPECT_EQ(times, -3);
  });
  const Pose2 pose{.x = 1, .y = 2, .heading = 3};
  Pose2 read;
  ASSERT_TRUE(form->WriteResponse({.success = true, .message = ""}, &pose, octets));
  const auto answered = form->ReadResponse(octets, &read);
  ASSERT_TRUE(answered);
  EXPECT_TRUE(answered->success);
  EXPECT_DOUBLE_EQ(read.heading, 3);
  ASSERT_TRUE(form->WriteResponse({.success = false, .message = "no such place"}, nullptr, octets));
  const auto failed = form->ReadResponse(octets, &read);
  ASSERT_TRUE(failed);
  EXPECT_FALSE(failed->success);
  EXPECT_EQ(failed->message, "no such place");
}

TEST(ServiceFormTest, AListIsCalledData) {
  const auto form = Make(nullptr, &TypeOf<std::vector<std::string>>());
  const std::vector<std::string> names = {"start", "dock"};
  std::vector<std::string> read;
  Octets octets;
  ASSERT_TRUE(form->WriteResponse({.success = true, .message = ""}, &names, octets));
  ASSERT_TRUE(form->ReadResponse(octets, &read));
  EXPECT_THAT(read, ElementsAre("start", "dock"));
}

TEST(ServiceFormTest, ATextIsTheMessageAndABoolTheSuccess) {
  Octets octets;
  const std::string text = "it burns";
  std::string heard;
  const auto trigger = Make(nullptr, &TypeOf<std::string>(), "std_srvs/srv/Trigger");
  ASSERT_TRUE(trigger->WriteResponse({.success = true, .message = ""}, &text, octets));
  ASSERT_TRUE(trigger->ReadResponse(octets, &heard));
  EXPECT_EQ(heard, "it burns");
  const auto flag = Make(&TypeOf<bool>(), &TypeOf<bool>(), "std_srvs/SetBool");
  bool no = false, said = true;
  ASSERT_TRUE(flag->WriteResponse({.success = true, .message = ""}, &no, octets));
  const auto read = flag->ReadResponse(octets, &said);
  EXPECT_TRUE(read && read->success) << "no is an answer";
  EXPECT_FALSE(said);
}

TEST(ServiceFormTest, AnOnlyArgumentMayHaveANameOfItsOwn) {
  const ArgumentType<bool> arguments({"on"});
  const auto form = Make(arguments.Get(), nullptr, "std_srvs/srv/SetBool");
  ArgumentPack<bool> asked, heard;
  WithArguments<bool>(asked, [](bool& on) { on = true; });
  Octets octets;
  form->WriteRequest(&asked, octets);
  ASSERT_TRUE(form->ReadRequest(octets, &heard));
  WithArguments<bool>(heard, [](bool on) { EXPECT_TRUE(on); });
}

TEST(ServiceFormTest, WhatCannotFailSaysSo) {
  const auto form = Make(nullptr, nullptr, "std_srvs/srv/Empty");
  Octets octets;
  EXPECT_TRUE(form->WriteResponse({.success = true, .message = ""}, nullptr, octets));
  EXPECT_FALSE(form->WriteResponse({.success = false, .message = "broken"}, nullptr, octets));
}

// Who calls would take why there is no reply for the reply.
TEST(ServiceFormTest, AMessageBesideAReplySaysNoError) {
  MessageLibrary library;
  const MessageField message{.name = "message", .type = MessageType::kString};
  const MessageField level{.name = "level", .type = MessageType::kFloat64};
  for (const char* const name : {"own_msgs/srv/Read", "own_msgs/srv/Measure", "own_msgs/srv/Do"}) {
    ASSERT_TRUE(library.Add({.name = std::string(name) + "_Request"}));
  }
  ASSERT_TRUE(library.Add({.name = "own_msgs/srv/Read_Response", .fields = {message}}));
  ASSERT_TRUE(library.Add({.name = "own_msgs/srv/Measure_Response", .fields = {message, level}}));
  ASSERT_TRUE(library.Add({.name = "own_msgs/srv/Do_Response", .fields = {message}}));
  const auto make = [&](const TypeInfo* reply, const std::string& as) {
    return *ServiceForm::Make(nullptr, reply, as, library);
  };
  const ServiceForm::Outcome failed{.success = false, .message = "it is broken"};
  Octets octets;
  const auto read = make(&TypeOf<std::string>(), "own_msgs/srv/Read");
  EXPECT_FALSE(read->WriteResponse(failed, nullptr, octets));
  const ArgumentType<double> levels({"level"});
  EXPECT_FALSE(make(levels.Get(), "own_msgs/srv/Measure")->WriteResponse(failed, nullptr, octets));
  EXPECT_TRUE(make(nullptr, "own_msgs/srv/Do")->WriteResponse(failed, nullptr, octets))
      << "a message is all that it says";
  const std::string text = "it burns";
  std::string heard;
  ASSERT_TRUE(read->WriteResponse({.success = true, .message = ""}, &text, octets));
  ASSERT_TRUE(read->ReadResponse(octets, &heard));
  EXPECT_EQ(heard, text);
}

TEST(ServiceFormTest, WhatDoesNotFitIsTold) {
  EXPECT_THAT(WhyNot(nullptr, nullptr, "std_srvs/srv/Triger"), HasSubstr("did you mean 'std_srvs/srv/Trigger'?"));
  EXPECT_THAT(WhyNot(nullptr, nullptr, "std_srvs/srv/SetBool"), HasSubstr("has nothing of"));
  EXPECT_THAT(WhyNot(&TypeOf<Pose2>(), nullptr, "std_srvs/srv/SetBool"), HasSubstr("has nothing of"));
  EXPECT_THAT(WhyNot(nullptr, &TypeOf<Pose2>(), "std_srvs/srv/Trigger"), HasSubstr("has nothing of"));
}

// The first eight octets, as the number that stands in front.
std::uint64_t FirstOf(const WireId& id) {
  std::uint64_t first;
  std::memcpy(&first, id.data(), sizeof first);
  return first;
}
WireId WithFirst(std::uint64_t first) {
  WireId id{};
  std::memcpy(id.data(), &first, sizeof first);
  return id;
}

TEST(ServiceMessagesTest, AreTheMessageWithTheCallInFront) {
  const Octets message = {std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}, std::byte{7}};
  const Octets whole = WithCallId({.client = WithFirst(5), .number = -2}, message);
  EXPECT_EQ(whole.size(), message.size() + 16);
  const auto split = SplitCallId(whole);
  ASSERT_TRUE(split);
  EXPECT_EQ(FirstOf(split->id.client), 5u);
  EXPECT_EQ(split->id.number, -2);
  EXPECT_EQ(split->message, message);
  for (std::size_t size = 0; size < 20; ++size) EXPECT_FALSE(SplitCallId(std::span(whole).first(size))) << size;
  EXPECT_TRUE(SplitCallId(std::span(whole).first(20)));
}

TEST(ServiceMessagesTest, OfTheOtherOrderOfOctetsAreRead) {
  Octets whole(21, std::byte{0});
  whole[11] = std::byte{5};
  whole[19] = std::byte{2};
  const auto split = SplitCallId(whole);
  ASSERT_TRUE(split);
  EXPECT_EQ(FirstOf(split->id.client), 5u);
  EXPECT_EQ(split->id.number, 2);
}

}  // namespace
}  // namespace runnel::test
