#include <stdexcept>
#include <string>

#include <acmill.h>
#include <mill_cxx_types.h>

typedef std::vector<std::string> Trace;

// Of the program, if that has codels fail.
extern "C" __attribute__((weak)) void InjectionPointForPlugins();
static void MayFail() {
  if (InjectionPointForPlugins != nullptr) InjectionPointForPlugins();
}

struct mill::store_s {
  int passes;
};

genom::event mill_begin(double& gain, ::mill::store_s*& store, Trace& trace) {
  MayFail();
  gain = 2;
  static mill::store_s only;  // not from the heap: no codel gives it back where a mistake stops the component
  store = &only;
  trace.clear();
  trace.push_back("begin");
  return mill::pass;
}

genom::event mill_pass(::mill::seen& seen, double gain, ::shape::reading& last, ::mill::ground& ground,
                       ::mill::way& way, Trace& trace) {
  seen.read();
  try {
    last = seen.data();
  } catch (const genom::exception&) {
    trace.push_back("nothing seen");
    return mill::pause::pass;
  }
  trace.push_back("pass");
  if (last.at.x == 99) {
    mill::jammed jammed;
    jammed.detail.which = shape::right;
    strcpy(jammed.detail.by, "sand");
    throw jammed;
  }
  ground.data() = last;
  ground.data().at.x *= gain;
  ground.data().trace.push_back(last.at);
  ground.write();
  way.data().push_back(last.at);
  way.write();
  return mill::pause::pass;
}

genom::event mill_rest(::mill::store_s*& store) {
  store = 0;
  return mill::ether;
}

genom::event mill_check(double gain, Trace& trace) {
  MayFail();
  trace.push_back("check");
  if (gain < 0) throw mill::worn();
  if (gain > 10) {
    mill::jammed jammed;
    jammed.detail.which = shape::left;
    strcpy(jammed.detail.by, "gain");
    throw jammed;
  }
  return genom::ok;
}

genom::event mill_beep(uint16_t times, int32_t& sum, Trace& trace) {
  MayFail();
  trace.push_back("beep");
  if (times > 100) throw mill::worn();
  if (times > 10) {
    beeper::tired tired;
    tired.detail.which = shape::right;
    tired.detail.limit = times;
    throw tired;
  }
  sum = times * 2;
  return genom::ok;
}

genom::event mill_say(const std::string& what, ::shape::side where, const int32_t three[3],
                      const ::shape::reading& seen, const genom::optional<int32_t>& level, std::string& said) {
  MayFail();
  said = what + (where == shape::right ? " right " : " left ") + std::to_string(three[0] + three[2] + level._value) +
         " " + std::to_string((int)seen.at.y) + " " + std::to_string(seen.trace.size());
  return genom::ok;
}

genom::event mill_open(const char from[8], const char to[8], ::mill::grain& grain, ::mill::flour& flour, Trace& trace) {
  MayFail();
  trace.push_back("open");
  grain.read(from);
  flour.open(to);
  return mill::go;
}

genom::event mill_pour(const char from[8], const char to[8], const Trace& names, double& value, std::string& said,
                       ::mill::grain& grain, ::mill::flour& flour, Trace& trace) {
  MayFail();
  trace.push_back("pour");
  value = grain.data(from);
  flour.data(to) = value;
  flour.write(to);
  for (size_t i = 0; i < names.size(); ++i) said += names[i];
  return mill::pause::last;
}

genom::event mill_last(const std::string& said, Trace& trace) {
  MayFail();
  trace.push_back("last " + said);
  return mill::ether;
}

genom::event mill_first(uint32_t times, std::vector<uint32_t>& left, Trace& trace) {
  MayFail();
  trace.push_back("first");
  for (; times > 0; --times) left.push_back(times);
  return mill::turn;
}

genom::event mill_turn(std::vector<uint32_t>& left, uint32_t& done) {
  MayFail();
  if (left.empty()) return mill::ether;
  if (left.back() == 77) throw std::runtime_error("a mistake");
  left.pop_back();
  ++done;
  return mill::pause::turn;
}

genom::event mill_stop(const std::vector<uint32_t>& left, uint32_t& done, Trace& trace) {
  MayFail();
  trace.push_back("stop");
  done = (uint32_t)(1000 + left.size());
  return mill::ether;
}

genom::event mill_add(const std::string& name, const genom::bounded_sequence<int32_t, 4>& values, int32_t& total,
                      ::shape::side& which, std::string& text, ::mill::sum& sum) {
  total = 100;
  sum.call(name, values, total, which, text);
  return mill::ether;
}
