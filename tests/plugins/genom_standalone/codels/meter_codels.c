#include "acmeter.h"
#include "meter_c_types.h"

genom_event check(double gain, const genom_context self)
{
  meter_wrong_detail detail = { right, 10 };
  return gain <= 10 ? genom_ok : meter_wrong(&detail, self);
}

genom_event begin(double *gain, const genom_context self)
{
  (void)self;
  *gain = 2;
  return meter_pass;
}

genom_event pass(double gain, const meter_seen *seen, const meter_echo *echo, const meter_range *range,
                 const meter_each *each, const genom_context self)
{
  seen->read(self);
  if (seen->data(self)) {
    *echo->data(self) = *seen->data(self);
    echo->data(self)->at[0] *= gain;
    echo->data(self)->at[1] *= gain;
    echo->write(self);
  }
  if (range->read("left", self) == genom_ok && each->open("copy", self) == genom_ok) {
    *each->data("copy", self) = *range->data("left", self);
    each->write("copy", self);
  }
  return meter_pause_pass;
}

genom_event read_all(double own_gain, side own_which, const sign *own_mark, const optional_double *own_best, double *gain,
                     side *which, sign *mark, optional_double *best, const genom_context self)
{
  (void)self;
  *gain = own_gain;
  *which = own_which;
  *mark = *own_mark;
  *best = *own_best;
  return genom_ok;
}

genom_event set_mark(const sign *new_mark, const optional_double *new_best, side new_which, sign *mark,
                     optional_double *best, side *which, const genom_context self)
{
  (void)self;
  *mark = *new_mark;
  *best = *new_best;
  *which = new_which;
  return genom_ok;
}

genom_event sum_all(const sequence4_long *values, int32_t *total, const char *name, char **text, reading *found,
                    const genom_context self)
{
  genom_syserr_detail error = { 22 };
  uint32_t i;
  if (!strcmp(name, "broken") || values->_maximum != 4 || found->trace._maximum != 4) return genom_syserr(&error, self);
  for (i = 0; i < values->_length; i++) *total += values->_buffer[i];
  free(*text);
  *text = (char *)malloc(strlen(name) + 5);
  strcpy(*text, "the ");
  strcat(*text, name);
  found->at[0] = 1.5;
  found->at[1] = 0.1;
  found->trace._length = 2;
  found->trace._buffer[0] = 7;
  found->trace._buffer[1] = 8;
  return genom_ok;
}

genom_event count_begin(uint32_t turns, uint32_t *left, const genom_context self)
{
  (void)self;
  *left = turns;
  return meter_turn;
}

genom_event count_turn(uint32_t *left, const genom_context self)
{
  (void)self;
  if (*left == 0) return meter_ether;
  --*left;
  return meter_pause_turn;
}

genom_event count_stop(uint32_t left, const genom_context self)
{
  (void)left;
  (void)self;
  return meter_ether;
}
