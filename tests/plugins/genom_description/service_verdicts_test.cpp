// The rules of tasks, services, codels and their parameters.

#include <gtest/gtest.h>

#include "tests/plugins/genom_description/verdict.h"

namespace runnel::test {
namespace {

TEST(GenomTasksTest, Properties) {
  ExpectVerdictsInComponent({
      {kRight, "task t;"},
      {kRight, "task t { period 20 ms; delay 5 ms; priority 10; scheduling real-time; stack 16k; doc \"d\"; };"},
      {kRight, "task t { delay 2500 us; period (2 + 3) ms; };"},
      {kRight, "task t { period 100us; }; task u { period 0.5s; }; task v { period 2; };"},
      {kWrong, "task t { delay 5 ms; };"},
      {kWrong, "task t { period 5 ms; delay 5 ms; };"},
      {kWrong, "task t { period -5 ms; };"},
      {kWrong, "task t { period TRUE; };"},
      {kWrong, "task t { period 5 ms; period 5 ms; };"},
      {kWrong, "task t { period 5 m; };"},
      {kRight, "task t { priority 999; };"},
      {kWrong, "task t { priority -1; };"},
      {kRight, "task t { period 5 ms; }; task t { priority 4; };"},
      {kWrong, "task t { interrupts all; };"},
      {kWrong, "task t { validate k(); };"},
      {kWrong, "task t { codel k(); };"},
      {kWrong, "task t { local long a; };"},
      {kWrong, "task t { version \"2\"; };"},
  });
}

TEST(GenomStateMachinesTest, OfTasks) {
  ExpectVerdictsInComponent({
      {kRight, "task t { codel<start> k() yield ether; };"},
      {kRight, "task t { codel<start> k() yields pause::start; };"},  // ended by interruption only
      {kRight, "task t { codel<start, run> k() yield run, pause::run, ether; };"},
      {kRight, "task run { codel<start> k() yield run; codel<run> l() yield ether; };"},
      {kRight, "task t { codel<stop> k() yield ether; };"},
      {kWrong, "task t { codel<run> k() yield ether; };"},
      {kWrong, "task t { codel<start> k() yield run; };"},
      {kWrong, "task t { codel<start> k(); };"},
      {kWrong, "task t { codel<> k() yield ether; };"},
      {kWrong, "task t { codel<start> k() yield; };"},
      {kWrong, "task t { codel<start> k() yield ether, ether; };"},
      {kRight, "task t { codel<start> k() yield start, pause::start; };"},
      {kWrong, "task t { codel<pause::start> k() yield ether; };"},
      {kWrong, "task t { codel<start> k() yield pause::ether; };"},
      {kWrong, "task t { codel<start> k() yield ether; codel<start> l() yield ether; };"},
      {kWrong, "task t { codel<start> k() yield run; codel<run> k() yield ether; };"},
      {kRight, "task t { codel<start> k() yield run; }; task t { codel<run> l() yield ether; };"},
      {kWrong, "task t { codel<start> k() yield run; }; task t { codel<run> k() yield ether; };"},
      {kWrong, "task t { codel<stop> k() yield pause::stop; };"},
      {kRight, "task t { codel<stop> k() yield run; codel<run> l() yield run, ether; };"},
      {kWrong, "task t { codel<start> k() yield ether wcet 5 ms; };"},
      {kWrong, "typedef double run; task t { codel<start> k() yield run; codel<run> l() yield ether; };"},
      {kWrong, "task t { codel<start> k() yield run; codel<run> l() yield ether; }; typedef double run;"},
  });
}

TEST(GenomStateMachinesTest, OfActivities) {
  ExpectVerdictsInComponent({
      {kRight,
       "task t; activity f() { task t; codel<start> k() yield pause::start, ether; codel<stop> l() yield ether; };"},
      {kRight, "task t; activity f() { task t; codel<start> k() yield pause::start; };"},
      {kWrong, "task t; activity f() { task t; codel<run> k() yield ether; };"},
      {kWrong, "task t; activity f() { task t; };"},
      {kWrong, "task t; activity f() { codel<start> k() yield ether; };"},
      {kWrong, "activity f() { task t; codel<start> k() yield ether; }; task t;"},
      {kWrong, "task t; activity f() { task t; codel k(); };"},
      {kWrong, "task t; activity f() { task t; codel<start> k() yield ether; codel<odd> l() yield ether; };"},
      {kRight, "task t; task u; activity f() { task t; task u; codel<start> k() yield ether; };"},  // the first holds
      {kWrong, "task t; activity f() { task t; period 5 ms; codel<start> k() yield ether; };"},
      {kRight,
       "task t; activity f(in long a) { task t; }; activity f(in long a) { codel<start> k(in a) yield ether; };"},
  });
}

TEST(GenomServicesTest, NamesAndOrder) {
  ExpectVerdictsInComponent({
      {kRight, "function f(); function f(); function start(); function pause();"},
      {kWrong, "function all();"},
      {kWrong, "function f(); attribute f();"},
      {kWrong, "function f(in long a); function f(in long a, in long b);"},
      {kRight, "function f() { interrupts g; before g; after all; }; function g();"},
      {kRight, "function f() { interrupts f; };"},
      {kWrong, "function f() { interrupts h; };"},
      {kWrong, "function f() { before h; };"},
      {kWrong, "function f() { interrupts all, all; };"},
      {kRight, "function f() { interrupts g; interrupts f; }; function g();"},
      {kWrong, "function f() { before g; before f; }; function g();"},
      {kWrong, "task t; function f() { task t; };"},
      {kWrong, "function f() { codel<start> k() yield ether; };"},
      {kRight, "function f() { codel k(); codel l(); validate v(); };"},
      {kWrong, "function f() { codel k(); validate k(); };"},
      {kWrong, "exception e; function f() { throw e, e; };"},
      {kWrong, "exception e; function f() { throw e, ::c::e; };"},
      {kRight, "exception e, g; function f() { throw e; throw g; };"},
      {kWrong, "service go() { };"},
  });
}

TEST(GenomServicesTest, Parameters) {
  ExpectVerdictsInComponent({
      {kRight, "function f(in double a, out double b, inout double d) { codel k(in a, out b, inout d); };"},
      {kRight, "function f(in double a) { codel k(out a); };"},
      {kWrong, "function f(double a);"},
      {kWrong, "function f(in double a,);"},
      {kWrong, "function f(in double a, in long a);"},
      {kRight, "function f(in struct s { long a; } b); typedef s t;"},
      {kWrong, "native n; function f(in n a);"},
      {kWrong, "native n; typedef sequence<n> m; function f(in m a);"},
      {kWrong, "native n; ids { n v; }; attribute f(in v);"},
      {kWrong, "native n; ids { struct s { n v; } w; }; attribute f(out ::all);"},
      {kRight, "native n; ids { n v; }; function f() { codel k(inout v); };"},
      {kRight, "function f() { local long a, b[2]; codel k(out a, inout b[1]::d); };"},
      {kWrong, "function f() { codel k(out a); local long a; };"},
      {kWrong, "function f(in long a) { local long a; };"},
      {kRight, "ids { double v, w; }; attribute f(in v = 2 : \"m/s\", out w = : \"rad/s\");"},
      {kRight, "ids { double v; }; attribute f(out ::all); attribute g();"},
      {kRight, "ids { struct s { double v[2]; } a; }; attribute f(in a.v[1]::speed);"},
      {kWrong, "ids { double v; }; attribute f(in w);"},
      {kWrong, "ids { double v; }; attribute f(in double v);"},
      {kWrong, "ids { double v; }; attribute f(v);"},
      {kWrong, "attribute f(in v);"},
      {kWrong, "ids { double v; }; attribute f(in v) { validate k(in v); };"},
      {kRight, "ids { double v; }; attribute f(in v) { validate k(local in v); codel l(ids in v); };"},
      {kWrong, "ids { double v; }; attribute f(in v) { local long a; };"},
  });
}

TEST(GenomServicesTest, Defaults) {
  const std::string types = "struct s { long a, b; struct p { double x; } d; }; enum e { A, B }; ";
  ExpectVerdictsInComponent({
      {kRight, types + "function f(in s v = { 1, 2, { 3 } } : \"doc\");"},
      {kRight, types + "function f(in s v = { .b = 1 : \"one\", { .x = 2 } : \"two\" });"},
      {kRight, types + "function f(in s v = { .a = 1, .a = 2 });"},
      {kRight, types + "function f(in s v = { .a =, .b = : \"documented only\" });"},
      {kRight, types + "function f(in s v = : \"doc\", in s w = {}, out long x = 3);"},
      {kWrong, types + "function f(in s v = { 1, 2, { 3 }, 4 });"},
      {kWrong, types + "function f(in s v = { .z = 1 });"},
      {kWrong, types + "function f(in s v = { [0] = 1 });"},
      {kWrong, types + "function f(in s v = 1);"},
      {kWrong, types + "function f(in s v = { 1.5 });"},
      {kWrong, types + "function f(in s v = { 1, };"},
      {kRight, "function f(in double v[3] = { 1, [2] = 3 });"},
      {kWrong, "function f(in double v[3] = { 1, [3] = 3 });"},
      {kWrong, "function f(in double v[2] = { 1, 2, 3 });"},
      {kWrong, "function f(in double v[2] = 1);"},
      {kWrong, "function f(in double v = { 1 });"},
      {kWrong, "function f(in double v[2] = { .a = 1 });"},
      {kRight, "function f(in sequence<long> v = { 1, [70] = 2 });"},
      {kWrong, "function f(in sequence<long, 2> v = { [2] = 2 });"},
      {kRight,
       types + "function f(in e v = B, in boolean w = TRUE, in optional<s> x = { 1 }, in optional<long> y = 2);"},
      {kWrong, types + "function f(in e v = 1);"},
      {kRight, "function f(in string<3> v = \"four\");"},
      {kWrong, "function f(in string v = 4);"},
  });
}

TEST(GenomCodelParametersTest, WhereTheirDataAre) {
  const std::string ids =
      "typedef double d; port in d in_port; port out d out_port; native n;"
      "ids { long a; struct s { double x, y[3]; sequence<long> q; optional<long> o; } b[2]; sequence<long, 4> g;"
      " string<8> text; optional<s> last; union u switch(long) { case 1: s left; } either; n own; };";
  const auto with = [&](const std::string& parameters) {
    return ids + "task t { codel<start> k(" + parameters + ") yield ether; };";
  };
  ExpectVerdictsInComponent({
      {kRight, with("in a, out b[1].y[2]::z, inout g[3]::third")},
      {kRight, with("in b[0].q[1000], in b[1].o, in last.x, in either.left.y, out own")},
      {kRight, with("out ::everything, ids in a")},
      {kRight, with("in a, in a::again")},
      {kWrong, with("in a, out a")},
      {kWrong, with("a")},
      {kWrong, with("in")},
      {kWrong, with("in unknown")},
      {kWrong, with("in a.b")},
      {kWrong, with("in a[0]")},
      {kWrong, with("in b[2]")},
      {kWrong, with("in b[0].y[3]")},
      {kWrong, with("in g[4]")},
      {kWrong, with("in text[1]")},
      {kWrong, with("in b.x")},
      {kWrong, with("in b[-1]")},
      {kRight, with("in in_port, out out_port")},
      {kRight, with("port in in_port::p, port in out_port")},
      {kWrong, with("out in_port")},
      {kWrong, with("inout in_port")},
      {kWrong, with("in in_port.x")},
      {kWrong, with("port in a")},
      {kWrong, with("local in a")},
      {kWrong, with("remote in a")},
      {kWrong, with("port in ::p")},
  });
  ExpectVerdictsInComponent({
      {kWrong, "typedef double d; ids { d p; }; port out d p; task t { codel<start> k(out p) yield ether; };"},
      {kRight,
       "typedef double d; ids { d p; }; port out d p; task t { codel<start> k(port out p, ids in p::q) yield ether; "
       "};"},
      {kWrong, "task t { codel<start> k(out v) yield ether; }; typedef double d; port out d v;"},
      {kWrong, "task t { codel<start> k(out ::ids) yield ether; };"},
      {kWrong, "typedef double d; port in d p; function f() { codel k(in p); };"},
      {kWrong, "typedef double d; port in d p; function f() { validate k(in p); };"},
  });
}

TEST(GenomCodelsTest, OneFunctionHasOneSignature) {
  ExpectVerdictsInComponent({
      {kRight, "function f(in long a) { codel k(in a); }; function g(in long b) { codel k(in b); };"},
      {kWrong, "function f(in long a) { codel k(in a); }; function g(in double a) { codel k(in a); };"},
      {kWrong, "function f(in long a) { codel k(in a); }; function g(in long a) { codel k(out a); };"},
      {kWrong, "function f(in long a) { codel k(in a); }; function g() { codel k(); };"},
  });
}

TEST(GenomCodelsTest, AsynchronousOnesShareNothing) {
  const std::string ids = "ids { long v; }; task t { async codel<start> k(in v) yield ether; };";
  ExpectVerdictsInComponent({
      {kRight, ids + "attribute f(out v); task u { codel<start> l() yield m; codel<m> n(in v) yield ether; };"},
      {kWrong, ids + "attribute f(in v);"},
      {kWrong, ids + "function f() { codel l(out v); };"},
      {kRight, ids + "task u { codel<start> l(out v) yield ether; };"},
      {kRight, ids + "task u { codel<start> l() yield ether; codel<stop> m(out v) yield ether; };"},
      {kWrong, ids + "task u { codel<start> l() yield m; codel<m> n(out v) yield ether; };"},
      {kWrong, ids + "task u; activity f() { task u; codel<start> l(out v) yield ether; };"},
      {kRight, "ids { long v; }; task t { async codel<start> k(out v) yield run; codel<run> l(out v) yield ether; };"},
  });
}

}  // namespace
}  // namespace runnel::test
