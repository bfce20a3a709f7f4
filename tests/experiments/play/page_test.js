'use strict';
// Runs in the page, after it and after `window.expected`, the native decoder's positions at some sizes: does what a
// reader would, and logs "passed" or what failed.
PageTest.run(async () => {
  const { expect, settled, pixels, painted, different } = PageTest;
  const view = JSON.parse(byId('played').textContent);
  const slide = (place) => { byId('budget').value = place; byId('budget').dispatchEvent(new Event('input')); };

  const handle = await Decoder.open(Surface.bytesOf(view.streams[0]));
  for (const { bytes, positions } of window.expected) {
    const decoded = await Decoder.decode(handle, bytes, view.level), native = Surface.bytesOf(positions);
    const bits = new Uint8Array(decoded.positions.buffer);
    expect(bits.length === native.length && bits.every((b, i) => b === native[i]), `positions at ${bytes} bytes are the native ones`);
  }
  expect(await Decoder.open(new Uint8Array([80, 71, 67, 9])).then(() => '', (e) => e.message).then((text) => /^bad-stream: /.test(text)), 'a damaged stream is refused with its cause');
  expect(await Decoder.decode(handle, 3, 1).then(() => '', (e) => e.message).then((text) => /^truncated: /.test(text)), 'and so is a prefix without its header');

  expect(byId('title').textContent === '<\/script><b>x@@play.js@@', 'the title is what was given');
  await settled(() => byId('view-message').hidden && painted(pixels()) > 0.05, 200);
  expect(painted(pixels()) > 0.05, 'the surface is drawn');
  const vertices = window.expected[2].positions.length * 3 / 4 / 24;
  expect(byId('decoded').textContent.includes(`${view.bytes.toLocaleString('en')} of`), 'the bytes are told');
  expect(byId('decoded').textContent.includes(`${Math.floor(vertices).toLocaleString('en')} vertices, level ${view.level}`), 'vertices and level are told');

  const whole = pixels();
  for (let k = 0; k < 600; ++k) slide(k % 1000);
  slide(500);
  const middle = () => location.hash.includes(`bytes=${bytesAt(500, 1000, view.header_bytes, view.bytes)}`);
  await settled(middle, 200);
  expect(middle(), 'of many sizes in a moment the last one is in the address');
  slide(0);
  await settled(() => different(whole, pixels()) > 0.001, 200);
  expect(different(whole, pixels()) > 0.001, 'fewer bytes decode to another surface');
  await settled(() => location.hash.includes(`bytes=${view.header_bytes}`), 200);
  expect(location.hash.includes(`bytes=${view.header_bytes}`), 'the size is in the address');
  await settled(() => byId('decoded').textContent.startsWith(`${view.header_bytes} of`), 200);
  expect(byId('decoded').textContent.startsWith(`${view.header_bytes} of`), 'the shortest prefix is the header');
  slide(1000);
  await settled(() => different(whole, pixels()) < 0.0001, 200);
  expect(different(whole, pixels()) < 0.0001, 'and all of them to the same as before');
  for (const kind of ['patches', 'isolines']) {
    document.querySelector(`#view-kinds button[data-value="${kind}"]`).click();
    await settled(() => different(whole, pixels()) > 0.01, 200);
    expect(different(whole, pixels()) > 0.01, `${kind} look different`);
  }
  byId('load').click();
  await settled(() => Number(byId('budget').value) > 5 && Number(byId('budget').value) < 900, 200);
  expect(Number(byId('budget').value) < 900, 'it plays from the first byte');
});
