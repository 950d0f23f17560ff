#include "plugins/web_server/access_rules.h"

#include <gmock/gmock.h>
#include <unistd.h>

namespace runnel::test {

namespace {

using ::testing::HasSubstr;

constexpr std::string_view kHost = "127.0.0.1:8765";

constexpr std::uint32_t kOther = 4242;

AccessRules Rules(std::vector<AccessToken> tokens = {}, std::vector<std::string> origins = {}) {
  return AccessRules(
      {.address = "0.0.0.0", .tokens = std::move(tokens), .origins = std::move(origins), .host_names = {"Robot.Lan"}});
}
const std::vector<AccessToken> kTokens{{WebRole::kChange, "open-sesame"}, {WebRole::kLook, "just-look-7"}};

/// 0: it is let in.
unsigned StatusOf(const std::variant<WebRole, AccessRules::Refusal>& access) {
  const auto* const refusal = std::get_if<AccessRules::Refusal>(&access);
  return refusal != nullptr ? refusal->status : 0;
}

TEST(AccessRules, LetsWhoCallsItByAddressOrNameIn) {
  const AccessRules rules = Rules();
  for (const char* host : {"127.0.0.1:8765", "127.0.0.1", "localhost:8765", "LOCALHOST", "[::1]:8765", "[::1]",
                           "192.168.1.7:8765", "robot.lan:8765", "ROBOT.LAN"}) {
    EXPECT_FALSE(rules.Check({.target = "/", .host = host})) << host;
  }
}

TEST(AccessRules, RefusesNamesThatSomebodyElseLetsLeadHere) {
  const AccessRules rules = Rules();
  for (const char* host :
       {"evil.example:8765", "localhost.evil.example", "127.0.0.1.evil.example", "127.0.0.1:8765.evil", "[::1",
        "[::1]evil", "", ":8765", "localhost:", "localhost:123456", "127.0.0.1 ", "[fe80::1%; script-src *]:8765"}) {
    EXPECT_TRUE(rules.Check({.target = "/", .host = host})) << host;
  }
}

// Who answers for the machine's name on a network could have it lead to a page of his own first, and then here.
TEST(AccessRules, OnALoopbackAddressTheMachinesOwnNameIsAForeignOne) {
  char name[256] = {};
  ASSERT_EQ(gethostname(name, sizeof name - 1), 0);
  const AccessRules near({.is_for_all_users = true});
  for (const std::string& host : {std::string(name), std::string(name) + ".local"}) {
    EXPECT_FALSE(Rules().Check({.target = "/", .host = host})) << host;
    if (std::string(name) != "localhost") {
      EXPECT_TRUE(near.Check({.target = "/", .host = host})) << host;
    }
  }
  EXPECT_FALSE(near.Check({.target = "/", .host = "localhost"}));
}

TEST(AccessRules, OnALoopbackAddressOnlyWhoStartedItNeedsNoToken) {
  const AccessRules rules(WebServerOptions{});
  EXPECT_TRUE(rules.AsksForUser());
  EXPECT_FALSE(rules.Check({.target = "/", .host = kHost, .user = geteuid()}));
  EXPECT_FALSE(rules.Check({.target = "/", .host = kHost, .user = 0}));
  const auto other = rules.Check({.target = "/", .host = kHost, .user = kOther});
  ASSERT_TRUE(other);
  EXPECT_EQ(other->status, 403U);
  EXPECT_THAT(other->text, HasSubstr("another user"));
  EXPECT_TRUE(rules.Check({.target = "/", .host = kHost})) << "nobody knows whose it is";
  EXPECT_FALSE(AccessRules({.is_for_all_users = true}).AsksForUser());
  EXPECT_FALSE(AccessRules({.tokens = kTokens}).AsksForUser()) << "the token says who may";
}

TEST(AccessRules, TakesATokenFromAddressProtocolsOrAuthorization) {
  const AccessRules rules = Rules(kTokens);
  const WebRequest none{.target = "/", .host = kHost};
  EXPECT_FALSE(rules.Check(none)) << "the page itself is no secret";
  EXPECT_EQ(StatusOf(rules.Admit(none)), 401U);
  const auto role = [&](const WebRequest& request) {
    const auto access = rules.Admit(request);
    EXPECT_EQ(StatusOf(access), 0U);
    return std::get<WebRole>(access);
  };
  EXPECT_EQ(role({.target = "/?token=open-sesame"}), WebRole::kChange);
  EXPECT_EQ(role({.target = "/?a=b&token=just-look-7&c"}), WebRole::kLook);
  EXPECT_EQ(role({.target = "/", .authorization = "bearer open-sesame"}), WebRole::kChange);
  EXPECT_EQ(role({.target = "/", .protocols = "runnel.inspector.v1, runnel.token.just-look-7"}), WebRole::kLook);
}

TEST(AccessRules, RefusesWhatIsAlmostTheToken) {
  const AccessRules rules = Rules(kTokens);
  for (const char* target : {"/?token=open-sesam", "/?token=open-sesame1", "/?token=", "/?token",
                             "/?mytoken=open-sesame", "/?token=OPEN-SESAME", "/token=open-sesame"}) {
    EXPECT_EQ(StatusOf(rules.Admit({.target = target})), 401U) << target;
  }
  for (const char* shown : {"Basic open-sesame", "open-sesame", "Bearer", "Bearer open-sesame x"}) {
    EXPECT_EQ(StatusOf(rules.Admit({.target = "/", .authorization = shown})), 401U) << shown;
  }
  EXPECT_EQ(StatusOf(rules.Admit({.target = "/", .protocols = "runnel.token.,open-sesame"})), 401U);
}

TEST(AccessRules, LetsPagesOfItsOwnAndListedOriginsTalk) {
  const AccessRules rules = Rules({}, {"https://app.example.org"});
  for (const char* origin :
       {"", "http://127.0.0.1:8765", "HTTP://127.0.0.1:8765", "https://127.0.0.1:8765", "https://app.example.org"}) {
    EXPECT_EQ(StatusOf(rules.Admit({.target = "/", .host = kHost, .origin = origin})), 0U) << origin;
  }
  for (const char* origin :
       {"null", "http://127.0.0.1", "http://127.0.0.1:8766", "http://localhost:8765", "file://",
        "http://127.0.0.1:8765.evil.example", "https://app.example.org.evil.example", "http://app.example.org"}) {
    EXPECT_EQ(StatusOf(rules.Admit({.target = "/", .host = kHost, .origin = origin})), 403U) << origin;
  }
}

TEST(AccessRules, ASecretThatAPageKnowsIsWorthMoreThanWhereItComesFrom) {
  const AccessRules rules = Rules(kTokens);
  const std::string_view elsewhere = "https://elsewhere.example";
  EXPECT_EQ(StatusOf(rules.Admit({.target = "/", .host = kHost, .origin = elsewhere})), 401U);
  EXPECT_EQ(StatusOf(rules.Admit({.target = "/?token=open-sesame", .host = kHost, .origin = elsewhere})), 0U);
}

TEST(AccessRules, KnowsWhichAddressesOnlyThisMachineReaches) {
  for (const char* address : {"127.0.0.1", "127.3.2.1", "::1"}) EXPECT_TRUE(*IsLoopback(address));
  for (const char* address : {"0.0.0.0", "192.168.0.1", "::", "fe80::1"}) {
    EXPECT_FALSE(*IsLoopback(address)) << address;
  }
  for (const char* address : {"", "localhost", "127.0.0", "127.0.0.1:80"}) {
    const auto answer = IsLoopback(address);
    ASSERT_FALSE(answer) << address;
    EXPECT_THAT(answer.error().hint, HasSubstr("127.0.0.1"));
  }
}

}  // namespace

}  // namespace runnel::test
