import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PixelsOf } from '../../../plugins/inspector/page/source/model/image_pixels.js';

const Base64 = (bytes) => Buffer.from(bytes).toString('base64');

test('pixels of each encoding become red, green, blue', () => {
  const of = (encoding, bytes, step) => [...PixelsOf({ width: 1, height: 2, encoding, step, data: Base64(bytes) }).pixels];
  assert.deepEqual(of('rgb8', [1, 2, 3, 4, 5, 6], 3), [1, 2, 3, 255, 4, 5, 6, 255]);
  assert.deepEqual(of('bgr8', [1, 2, 3, 0, 4, 5, 6], 4), [3, 2, 1, 255, 6, 5, 4, 255]);
  assert.deepEqual(of('mono8', [7, 9], 1), [7, 7, 7, 255, 9, 9, 9, 255]);
  assert.deepEqual(of('mono16', [0, 7, 0, 9], 2), [7, 7, 7, 255, 9, 9, 9, 255]);
});

test('what cannot be shown is said', () => {
  for (const encoding of ['yuv422', 'constructor', 'toString']) {
    assert.match(PixelsOf({ width: 1, height: 1, encoding, step: 2, data: Base64([1, 2]) }).problem, new RegExp(encoding));
  }
  assert.match(PixelsOf({ width: 2, height: 2, encoding: 'rgb8', step: 6, data: Base64([1, 2]) }).problem, /not whole/);
  assert.match(PixelsOf({ width: 2, height: 2, encoding: 'rgb8', step: 6, data: [1, 2] }).problem, /too large/);
});
