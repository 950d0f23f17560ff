// How the numbers of one live value are written: each field with as many decimals as the largest number that
// it had needs, and room for a sign if it had one, so that nothing jumps while the value changes.

import { FormatNumber } from './value_format.js';

const kMostDecimals = 9;
const kFigureSpace = '\u2007'; // as wide as a digit

export class NumberScales {
  #fields = new Map(); // field -> {most, isSigned, isWhole}

  format(number, field = '') {
    if (typeof number !== 'number' || !Number.isFinite(number)) return FormatNumber(number);
    const known = this.#fields.get(field) ?? { most: 0, isSigned: false, isWhole: true };
    const scale = { most: Math.max(known.most, Math.abs(number)), isSigned: known.isSigned || number < 0,
      isWhole: known.isWhole && Number.isInteger(number) };
    this.#fields.set(field, scale);
    const text = Digits(number, scale);
    return scale.isSigned && !text.startsWith('−') ? kFigureSpace + text : text;
  }
}

function Digits(number, { most, isWhole }) {
  if (isWhole || most >= 1e6 || most < 1e-9) return FormatNumber(number);
  const decimals = most >= 1000 ? 1 : most >= 100 ? 2 : Math.min(kMostDecimals, Math.max(3, 2 - Math.floor(Math.log10(most))));
  const text = number.toFixed(decimals);
  return Number(text) === 0 ? text.replace('-', '') : text.replace('-', '−');
}
