#include "tests/plugins/genom_description/mutation.h"

#include <algorithm>
#include <array>

namespace runnel::test {

namespace {

constexpr std::array kPieces = {"component c {",
                                "interface i {",
                                "};",
                                "}",
                                "{",
                                "(",
                                ")",
                                "<",
                                ">",
                                "<<",
                                ">>",
                                ";",
                                ",",
                                "::",
                                ":",
                                "=",
                                ".",
                                "[",
                                "]",
                                "#if 1\n",
                                "\n#if 0\n",
                                "\n#else\n",
                                "\n#elif 1/0\n",
                                "\n#endif\n",
                                "\n#define A(x) x ## A(A(x)) #x\n",
                                "A(",
                                "A(1)",
                                "\n#undef A\n",
                                "\n#define B B C\n#define C C B\n",
                                "B",
                                "\n#include \"",
                                "\n#include \"self.gen\"\n",
                                "\n#line 4294967296 \"x\"\n",
                                "\\\n",
                                "/*",
                                "*/",
                                "//",
                                "/*/",
                                "\"",
                                "'",
                                "\n#pragma masquerade a c 1\n",
                                "\n#pragma provides i\n",
                                "\n#pragma requires x\n",
                                "struct s {",
                                "union u switch(long) {",
                                "case 1:",
                                "default:",
                                "enum e {",
                                "sequence<",
                                "optional<",
                                "string<",
                                "long a[2];",
                                "typedef ",
                                "exception e;",
                                "native n;",
                                "ids {",
                                "port in ",
                                "port out ",
                                "multiple ",
                                "task t {",
                                "activity f(",
                                "function g(",
                                "attribute h(",
                                "in ",
                                "out ",
                                "inout ",
                                "local ",
                                "remote ",
                                "ids ",
                                "codel<start> k(",
                                ") yield ether;",
                                "yield pause::start, main;",
                                "codel<stop> l() yield ether;",
                                "async ",
                                "validate v(",
                                "provides i;",
                                "uses i;",
                                "extends i;",
                                "throw e;",
                                "interrupts all;",
                                "before f;",
                                "after f;",
                                "period 5ms;",
                                "delay 1ms;",
                                "clock-rate 1ms;",
                                "priority 300;",
                                "stack 64k;",
                                "scheduling real-time;",
                                "18446744073709551615",
                                "18446744073709551616",
                                "-9223372036854775808",
                                "1e308",
                                "0x",
                                "1/0",
                                "1%0",
                                "1<<64",
                                "~0",
                                "-1",
                                "TRUE",
                                "struct s;",
                                "s",
                                "::ids",
                                "c::",
                                "pause::",
                                "start",
                                "stop",
                                "ether",
                                "\xff",
                                "\0x"};

std::size_t Below(std::size_t bound, std::mt19937& random) {
  return bound == 0 ? 0 : static_cast<std::size_t>(random() % bound);
}

void MutateOnce(std::string& text, const std::vector<std::string>& seeds, std::mt19937& random) {
  const std::size_t at = Below(text.size() + 1, random);
  const std::size_t length = Below(std::min<std::size_t>(text.size() - at + 1, 60), random);
  switch (random() % 8) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(random());
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, text.substr(at, length));
      break;
    case 3: {
      const std::string& other = seeds[Below(seeds.size(), random)];
      text.insert(at, other.substr(Below(other.size() + 1, random), Below(120, random)));
      break;
    }
    case 4: {
      // Deeply nested.
      const std::string piece = kPieces[Below(kPieces.size(), random)];
      const std::size_t count = random() % 16 == 0 ? 2000 : 3;
      std::string many;
      for (std::size_t i = 0; i < count; ++i) many += piece;
      text.insert(at, many);
      break;
    }
    default:
      text.insert(at, kPieces[Below(kPieces.size(), random)]);
  }
}

}  // namespace

std::string Mutated(const std::vector<std::string>& seeds, std::mt19937& random) {
  std::string text = seeds[Below(seeds.size(), random)];
  const std::size_t count = random() % 2 == 0 ? 1 : 1 + Below(6, random);
  for (std::size_t i = 0; i < count; ++i) MutateOnce(text, seeds, random);
  return text;
}

}  // namespace runnel::test
