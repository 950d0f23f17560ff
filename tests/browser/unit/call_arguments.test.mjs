// What the form of a service makes of its fields.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CallArguments, FormFields } from '../../../plugins/inspector/page/source/model/call_arguments.js';

const kSave = { arguments: 'arguments', fields: [
  { name: 'file', data_type: 'string', unit: '', description: '', value: '' },
  { name: 'copies', data_type: 'int32', unit: '', description: '', value: '1' }] };

test('fields become a structure, texts in quotation marks', () => {
  assert.equal(CallArguments(kSave, { file: 'a "b".pgm' }), '{file: "a \\"b\\".pgm", copies: 1}');
  assert.equal(FormFields(kSave).length, 2);
});

test('the only argument stands for itself, and nothing for none', () => {
  const half = { arguments: 'double', value: '0' };
  assert.equal(CallArguments(half, { '': '5' }), '5');
  assert.equal(CallArguments(half, {}), '0');
  assert.deepEqual(FormFields(half).map((each) => each.data_type), ['double']);
  assert.equal(CallArguments({ arguments: '' }, {}), '');
  assert.deepEqual(FormFields({ arguments: '' }), []);
});
