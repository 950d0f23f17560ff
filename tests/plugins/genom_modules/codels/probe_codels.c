#include <math.h>
#include <pthread.h>
#include <unistd.h>

#include "acprobe.h"
#include "probe_c_types.h"

struct probe_store_s {
  pthread_t thread;
  int passes;
};

static pthread_t cycle_thread;

genom_event do_check(double gain, const genom_context self) {
  const probe_wrong_detail detail = {shape_right, 10};
  return fabs(gain) <= 10 ? genom_ok : probe_wrong(&detail, self);
}

genom_event do_begin(double *gain, probe_store_s **store, const genom_context self) {
  (void)self;
  *gain = 2;
  *store = (probe_store_s *)calloc(1, sizeof(**store));
  cycle_thread = pthread_self();
  return probe_pass;
}

genom_event do_pass(const probe_seen *seen, double gain, shape_reading *last, const probe_echo *echo,
                    const genom_context self) {
  seen->read(self);
  if (seen->data(self)) {
    const probe_wrong_detail detail = {shape_left, 99};
    *last = *seen->data(self);
    if (last->at.x == 99) return probe_wrong(&detail, self);
    *echo->data(self) = *last;
    echo->data(self)->at.x *= gain;
    echo->write(self);
  }
  return probe_pause_pass;
}

genom_event do_rest(probe_store_s **store, const probe_echo *echo, const genom_context self) {
  (void)echo;
  (void)self;
  free(*store);
  *store = NULL;
  return probe_ether;
}

genom_event do_sum(const char *name, const sequence4_long *values, int32_t *total, shape_side *which, char **text,
                   const genom_context self) {
  (void)self;
  for (uint32_t i = 0; i < values->_length; ++i) *total += values->_buffer[i];
  *which = shape_right;
  free(*text);
  *text = (char *)malloc(strlen(name) + 5);
  strcpy(*text, "the ");
  strcat(*text, name);
  return genom_ok;
}

genom_event do_copy(const char from[8], const char to[8], double *value, const probe_many *many,
                    const probe_copies *copies, const genom_context self) {
  genom_event failed = many->read(from, self);
  if (!failed) failed = copies->open(to, self);
  if (failed) return failed;
  *value = many->data(from, self) ? *many->data(from, self) : -1;
  *copies->data(to, self) = *value;
  copies->write(to, self);
  return probe_ether;
}

genom_event do_look(const probe_sighted *sighted, const genom_context self) {
  sighted->read(self);
  return probe_aim;
}

genom_event do_aim(const probe_aimed *aimed, const genom_context self) {
  aimed->write(self);
  return probe_pause_aim;
}

genom_event do_guess(bool looks, const probe_sighted *sighted, const probe_aimed *aimed, const genom_context self) {
  if (looks) sighted->read(self);
  aimed->write(self);
  return probe_pause_start;
}

genom_event do_first(uint32_t turns, uint32_t *left, const genom_context self) {
  (void)self;
  *left = turns;
  return probe_turn;
}

genom_event do_turn(uint32_t *left, uint32_t *done, const genom_context self) {
  (void)self;
  if (*left == 0) return probe_ether;
  --*left;
  ++*done;
  return probe_pause_turn;
}

genom_event do_stop(uint32_t left, uint32_t *done, const genom_context self) {
  (void)self;
  *done = 1000 + left;
  return probe_ether;
}

genom_event do_slow(bool *is_elsewhere, const genom_context self) {
  (void)self;
  *is_elsewhere = !pthread_equal(pthread_self(), cycle_thread);
  return probe_ether;
}

genom_event do_grind(uint32_t times, uint32_t microseconds, uint32_t *done, const genom_context self) {
  (void)self;
  usleep(microseconds);
  return ++*done < times ? probe_start : probe_ether;
}

genom_event do_ask(uint16_t times, const probe_beep *beep, int32_t *sum, const genom_context self) {
  const genom_event failed = beep->call(times, sum, self);
  return failed ? failed : probe_ether;
}
