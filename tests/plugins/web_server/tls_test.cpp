#include <filesystem>
#include <fstream>

#include <openssl/ssl.h>
#include <signal.h>
#include <sys/stat.h>

#include "tests/plugins/web_server/certificate.h"
#include "tests/plugins/web_server/tls_client.h"
#include "tests/plugins/web_server/web_server_fixture.h"
#include "tests/support/held_resources.h"

namespace runnel::test {

namespace {

const std::string kGet = "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";

std::string Handshake(const std::string& origin) {
  return "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Protocol: echo.v1\r\nOrigin: " +
         origin + "\r\n\r\n";
}

class Tls : public WebServerTest {
 protected:
  // OpenSSL writes into sockets that may have been closed.
  Tls() { signal(SIGPIPE, SIG_IGN); }
  static void SetUpTestSuite() { ours = std::make_unique<Certificate>("ours"); }
  static void TearDownTestSuite() { ours.reset(); }

  void StartTls(WebServerOptions options = {}) {
    options.certificate_file = ours->certificate;
    options.key_file = ours->key;
    Start(options);
  }

  static std::unique_ptr<Certificate> ours;
};
std::unique_ptr<Certificate> Tls::ours;

TEST_F(Tls, GivesThePage) {
  StartTls();
  EXPECT_THAT(server->url(), StartsWith("https://127.0.0.1:"));
  TlsClient client(server->port(), ours->certificate);
  ASSERT_TRUE(client.is_open());
  client.Send(kGet);
  EXPECT_THAT(client.Read(), HasSubstr("<p>page</p>"));
}

TEST_F(Tls, CarriesWebSockets) {
  StartTls();
  TlsClient client(server->port(), ours->certificate);
  client.Send(Handshake("https://localhost"));
  EXPECT_THAT(client.Read("\r\n\r\n"), StartsWith("HTTP/1.1 101 "));
  client.Send(RawClient::Frame(1, std::string(100'000, 'x') + "last"));
  EXPECT_THAT(client.Read("last"), HasSubstr("xxxlast"));
  TlsClient evil(server->port(), ours->certificate);
  evil.Send(Handshake("https://evil.example"));
  EXPECT_THAT(evil.Read("\r\n\r\n"), StartsWith("HTTP/1.1 403 "));
}

TEST_F(Tls, EndsSessionsWhenTheirClientsGo) {
  StartTls();
  {
    TlsClient client(server->port(), ours->certificate);
    client.Send(Handshake("https://localhost"));
    EXPECT_THAT(client.Read("\r\n\r\n"), StartsWith("HTTP/1.1 101 "));
  }
  WaitUntil("the session has ended", [&] { return met.ended == 1; });
}

TEST_F(Tls, IsShownByItsOwnCertificateAndNoOther) {
  const Certificate other("other");
  StartTls();
  EXPECT_FALSE(TlsClient(server->port(), other.certificate).is_open());
  EXPECT_TRUE(TlsClient(server->port(), ours->certificate).is_open());
}

TEST_F(Tls, OldVersionsAreRefused) {
  StartTls();
  EXPECT_FALSE(TlsClient(server->port(), ours->certificate, TLS1_1_VERSION).is_open());
  EXPECT_TRUE(TlsClient(server->port(), ours->certificate, TLS1_2_VERSION).is_open());
}

TEST_F(Tls, WhoForgetsToEncryptIsToldHow) {
  StartTls();
  RawClient client = Client();
  client.Send(kGet);
  const std::string answer = client.Read();
  EXPECT_THAT(answer, HasSubstr("https://"));
  EXPECT_THAT(answer, Not(HasSubstr("<p>page</p>")));
}

TEST_F(Tls, WhoBeginsAndGoesNoFurtherIsLetGo) {
  StartTls({.limits = {.request_time = 200ms}});
  RawClient silent = Client();
  RawClient slow = Client();
  slow.Send(std::string("\x16\x03\x01\x02\x00\x01", 6));
  EXPECT_TRUE(silent.IsClosed());
  EXPECT_TRUE(slow.IsClosed());
  RawClient garbage = Client();
  garbage.Send("\x16" + std::string(5000, 'x'));
  EXPECT_TRUE(garbage.IsClosed());
  EXPECT_TRUE(TlsClient(server->port(), ours->certificate).is_open());
}

TEST_F(Tls, ManyThatDoNotGoOnKeepNobodyOut) {
  StartTls({.limits = {.visitors = 8}});
  std::vector<RawClient> silent;
  for (int i = 0; i < 100; ++i) silent.push_back(Client());
  TlsClient client(server->port(), ours->certificate);
  ASSERT_TRUE(client.is_open());
  client.Send(kGet);
  EXPECT_THAT(client.Read(), HasSubstr("<p>page</p>"));
  EXPECT_TRUE(silent.front().IsClosed());
}

TEST_F(Tls, OneThatDoesNotReadIsLetGo) {
  StartTls({.limits = {.waiting_bytes = 1'000'000, .idle_time = 500ms}});
  TlsClient client(server->port(), ours->certificate);
  client.Send(Handshake("https://localhost"));
  EXPECT_THAT(client.Read("\r\n\r\n"), StartsWith("HTTP/1.1 101 "));
  client.Send(RawClient::Frame(1, "much"));
  WaitUntil("it is let go", [&] { return met.ended == 1; });
  EXPECT_GT(met.refused, 0);
}

// Into the sockets within the process fits more than it takes in the time that a piece has.
TEST_F(Tls, WhoTakesALargeAnswerSlowlyHasAllOfIt) {
  StartTls({.limits = {.request_time = 500ms}});
  TlsClient client(server->port(), ours->certificate);
  ASSERT_TRUE(client.is_open());
  client.Send("GET /large HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  std::size_t taken = 0;
  const auto take = [&] {
    const std::size_t more = client.ReadPiece(16 * 1024).size();
    taken += more;
    return more > 0;
  };
  for (int i = 0; i < 30 && take(); ++i) std::this_thread::sleep_for(100ms);
  while (take()) {
  }
  EXPECT_GT(taken, kLarge.size());
}

TEST_F(Tls, WhoTakesNothingOfAnAnswerIsLetGo) {
  StartTls({.limits = {.idle_time = 300ms}});
  TlsClient client(server->port(), ours->certificate);
  ASSERT_TRUE(client.is_open());
  client.Send("GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n");
  std::this_thread::sleep_for(2s);
  EXPECT_LT(client.Read().size(), kLarge.size());
}

/// Of what has been sent to clients they take nothing, and nobody loses patience.
class TlsThatIsStuck : public Tls {
 protected:
  static constexpr std::size_t kVisitors = 2, kClients = 6;
  static std::size_t Descriptors() { return HeldResources().files; }
  void SetUp() override {
    StartTls({.limits = {.visitors = kVisitors, .waiting_bytes = 100'000'000, .request_time = 1h, .idle_time = 1h}});
    before_ = Descriptors();
  }
  TlsClient& Connect() {
    clients_.push_back(std::make_unique<TlsClient>(server->port(), ours->certificate));
    EXPECT_TRUE(clients_.back()->is_open());
    return *clients_.back();
  }
  // A visitor has three: the connection, and both ends within the process.
  void ExpectNoMoreThanVisitorsHave() {
    EXPECT_TRUE(Eventually([&] { return Descriptors() <= before_ + kClients + 3 * kVisitors; })) << Descriptors();
  }

  std::vector<std::unique_ptr<TlsClient>> clients_;

 private:
  std::size_t before_ = 0;
};

TEST_F(TlsThatIsStuck, WhoMakesRoomForAnotherLeavesNothing) {
  for (std::size_t i = 0; i < kClients; ++i) {
    Connect().Send("GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n");
    std::this_thread::sleep_for(200ms);  // until the sockets are full
  }
  ExpectNoMoreThanVisitorsHave();
}

TEST_F(TlsThatIsStuck, WhatASessionHasLeftCountsAsAVisitor) {
  for (std::size_t i = 0; i < kClients; ++i) {
    TlsClient& client = Connect();
    client.Send(Handshake("https://localhost"));
    EXPECT_THAT(client.Read("\r\n\r\n"), StartsWith("HTTP/1.1 101 "));
    for (int j = 0; j < 4; ++j) client.Send(RawClient::Frame(1, "much"));
  }
  std::this_thread::sleep_for(2s);  // until the sockets are full
  for (const auto& each : clients_) each->Send(RawClient::Frame(1, "close"));
  WaitUntil("the sessions have ended", [&] { return met.ended == static_cast<int>(kClients); });
  ExpectNoMoreThanVisitorsHave();
}

TEST_F(Tls, TheTokenIsNeededAllTheSame) {
  StartTls({.tokens = {{WebRole::kChange, "open-sesame"}}});
  TlsClient client(server->port(), ours->certificate);
  client.Send(Handshake("https://localhost"));
  EXPECT_THAT(client.Read("\r\n\r\n"), StartsWith("HTTP/1.1 401 "));
}

TEST_F(Tls, OtherAddressesNeedItOrAreSaidToBeInsecure) {
  const auto open = WebServer::Start({.address = "0.0.0.0", .port = 0}, {}, {});
  ASSERT_FALSE(open);
  EXPECT_THAT(open.error().message, HasSubstr("nothing is encrypted"));
  EXPECT_THAT(open.error().hint, HasSubstr("--inspect-certificate"));
  EXPECT_THAT(open.error().hint, HasSubstr("--inspect-insecure"));
  EXPECT_TRUE(WebServer::Start({.address = "0.0.0.0", .port = 0, .is_insecure = true}, {}, {}));
  StartTls({.address = "0.0.0.0"});
  EXPECT_THAT(server->url(), StartsWith("https://"));
  EXPECT_EQ(server->made_token().size(), 32U) << "and a token besides";
}

class CertificateFiles : public Tls {
 protected:
  static Error ErrorOf(const std::string& certificate, const std::string& key) {
    const auto started = WebServer::Start({.port = 0, .certificate_file = certificate, .key_file = key}, {}, {});
    return started ? Error{} : started.error();
  }
};

TEST_F(CertificateFiles, ThatAreWrongAreNamedWithACure) {
  const Certificate other("another");
  const std::string text = ::testing::TempDir() + "no_certificate.pem";
  std::ofstream(text) << "hello\n";
  chmod(text.c_str(), 0600);
  struct Wrong {
    std::string certificate, key, file, message;
  };
  for (const Wrong& wrong :
       std::vector<Wrong>{{"/no/such.pem", ours->key, "/no/such.pem", "cannot be read"},
                          {ours->certificate, "/no/such.pem", "/no/such.pem", "cannot be read"},
                          {text, ours->key, text, "no certificate"},
                          {ours->certificate, text, text, "no key"},
                          {ours->certificate, "", ours->certificate, "no key"},
                          {"", ours->key, ours->key, "no certificate"},
                          {ours->certificate, other.key, other.key, "not that of the certificate"}}) {
    const Error error = ErrorOf(wrong.certificate, wrong.key);
    EXPECT_EQ(error.position.file, wrong.file);
    EXPECT_THAT(error.message, HasSubstr(wrong.message));
    EXPECT_NE(error.message.find("cannot be read") != std::string::npos || !error.hint.empty(), false) << error.message;
  }
  std::filesystem::remove(text);
}

TEST_F(CertificateFiles, AKeyThatEverybodyMayReadIsRefused) {
  const Certificate open("open");
  chmod(open.key.c_str(), 0644);
  const Error error = ErrorOf(open.certificate, open.key);
  EXPECT_EQ(error.position.file, open.key);
  EXPECT_THAT(error.hint, HasSubstr("chmod 600"));
}

TEST_F(CertificateFiles, AKeyWithAPasswordAsksNobody) {
  const std::string locked = ::testing::TempDir() + "locked.pem";
  const std::string command =
      "umask 077; openssl pkey -aes128 -passout pass:1234 -in '" + ours->key + "' -out '" + locked + "' 2>/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const Error error = ErrorOf(ours->certificate, locked);
  EXPECT_EQ(error.position.file, locked);
  EXPECT_THAT(error.hint, HasSubstr("password"));
  std::filesystem::remove(locked);
}

TEST_F(CertificateFiles, BothMayBeInOneFile) {
  const std::string both = ::testing::TempDir() + "both.pem";
  const std::string command = "umask 077; cat '" + ours->key + "' '" + ours->certificate + "' >'" + both + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(WebServer::Start({.port = 0, .certificate_file = both}, {}, {}));
  std::filesystem::remove(both);
}

}  // namespace

}  // namespace runnel::test
