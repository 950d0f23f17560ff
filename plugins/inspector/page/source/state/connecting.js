// Connecting two ports that are not of one type.

import { OnlyTypesDiffer, WhyNot } from '../model/compatibility.js';
import { IsMessage } from '../model/network.js';
import { Conversions } from './actions.js';
import { OpenLater, openDialog } from './choices.js';
import { structure } from './store.js';
import { Toast } from './toasts.js';

const kMeanwhile = 'another dialog was opened or closed before the application had told its conversions';

/** By a part of the values, or a conversion, if there is one; messages of ROS 2 are taken; else says why not. */
export async function ConnectOtherwise(port, other) {
  const ends = OnlyTypesDiffer(structure, port, other);
  const source = ends && structure.get(ends.from);
  if (ends && IsMessage(source)) {
    openDialog.value = { kind: 'take', path: ends.to, topic: source.topic, as: source.data_type };
    return;
  }
  const asked = openDialog.value;
  const reply = ends ? await Conversions(ends.from, ends.to) : { ok: false };
  if (reply.ok && reply.conversions.length > 0) {
    if (!OpenLater({ kind: 'convert', ...ends, conversions: reply.conversions }, asked)) Toast('refused', 'Not connected', [kMeanwhile]);
  } else Toast('refused', 'Not connected', [WhyNot(structure, port, other)]);
}
