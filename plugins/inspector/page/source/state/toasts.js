// Short messages that come up in a corner: errors stay until they are closed, the rest goes by itself.

import { signal } from '@preact/signals';

const kShown = 6;
const kMilliseconds = 4500;

export const toasts = signal([]);
let next = 1;

export function Toast(kind, text, details = []) {
  const toast = { number: next++, kind, text, details };
  toasts.value = [...toasts.value, toast].slice(-kShown);
  if (kind !== 'error') setTimeout(() => CloseToast(toast.number), kMilliseconds);
}

/** Takes away what has been said of something done. */
export function CloseDone() {
  if (toasts.value.some((toast) => toast.kind === 'done')) toasts.value = toasts.value.filter((toast) => toast.kind !== 'done');
}

export function CloseToast(number) {
  toasts.value = toasts.value.filter((toast) => toast.number !== number);
}
