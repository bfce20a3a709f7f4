'use strict';
// Runs in the page, after it and after `window.expected`, the native decoder's positions at some sizes: does what a
// reader would, and logs "passed" or what failed.
(async () => {
  const failures = [];
  const expect = (condition, text) => { if (!condition) failures.push(text); };
  const frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 20)));
  const settled = async (condition) => { for (let i = 0; i < 200 && !condition(); ++i) await frame(); };
  const view = JSON.parse(byId('played').textContent);
  const pixels = () => {
    const from = byId('view'), copy = document.createElement('canvas');
    copy.width = from.width;
    copy.height = from.height;
    const context = copy.getContext('2d');
    context.drawImage(from, 0, 0);
    return context.getImageData(0, 0, copy.width, copy.height).data;
  };
  const painted = (data) => { let n = 0; for (let i = 3; i < data.length; i += 4) n += data[i] > 0; return n / (data.length / 4); };
  const different = (a, b) => { let n = 0; for (let i = 0; i < a.length; i += 4) n += Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) > 24; return n / (a.length / 4); };
  const slide = (place) => { byId('budget').value = place; byId('budget').dispatchEvent(new Event('input')); };

  try {
    const handle = await Decoder.open(Surface.bytesOf(view.streams[0]));
    for (const { bytes, positions } of window.expected) {
      const decoded = await Decoder.decode(handle, bytes, view.level), native = Surface.bytesOf(positions);
      const bits = new Uint8Array(decoded.positions.buffer);
      expect(bits.length === native.length && bits.every((b, i) => b === native[i]), `positions at ${bytes} bytes are the native ones`);
    }
    expect(await Decoder.open(new Uint8Array([80, 71, 67, 9])).then(() => '', (e) => e.message).then((text) => /^bad-stream: /.test(text)), 'a damaged stream is refused with its cause');
    expect(await Decoder.decode(handle, 3, 1).then(() => '', (e) => e.message).then((text) => /^truncated: /.test(text)), 'and so is a prefix without its header');

    expect(byId('title').textContent === '<\/script><b>x@@play.js@@', 'the title is what was given');
    await settled(() => byId('view-message').hidden && painted(pixels()) > 0.05);
    expect(painted(pixels()) > 0.05, 'the surface is drawn');
    const vertices = window.expected[2].positions.length * 3 / 4 / 24;
    expect(byId('decoded').textContent.includes(`${view.bytes.toLocaleString('en')} of`), 'the bytes are told');
    expect(byId('decoded').textContent.includes(`${Math.floor(vertices).toLocaleString('en')} vertices, level ${view.level}`), 'vertices and level are told');

    const whole = pixels();
    for (let k = 0; k < 600; ++k) slide(k % 1000);
    slide(500);
    const middle = () => location.hash.includes(`bytes=${bytesAt(500, 1000, view.header_bytes, view.bytes)}`);
    await settled(middle);
    expect(middle(), 'of many sizes in a moment the last one is in the address');
    slide(0);
    await settled(() => different(whole, pixels()) > 0.001);
    expect(different(whole, pixels()) > 0.001, 'fewer bytes decode to another surface');
    await settled(() => location.hash.includes(`bytes=${view.header_bytes}`));
    expect(location.hash.includes(`bytes=${view.header_bytes}`), 'the size is in the address');
    await settled(() => byId('decoded').textContent.startsWith(`${view.header_bytes} of`));
    expect(byId('decoded').textContent.startsWith(`${view.header_bytes} of`), 'the shortest prefix is the header');
    slide(1000);
    await settled(() => different(whole, pixels()) < 0.0001);
    expect(different(whole, pixels()) < 0.0001, 'and all of them to the same as before');
    for (const kind of ['patches', 'isolines']) {
      document.querySelector(`#view-kinds button[data-value="${kind}"]`).click();
      await settled(() => different(whole, pixels()) > 0.01);
      expect(different(whole, pixels()) > 0.01, `${kind} look different`);
    }
    byId('load').click();
    await settled(() => Number(byId('budget').value) > 5 && Number(byId('budget').value) < 900);
    expect(Number(byId('budget').value) < 900, 'it plays from the first byte');
  } catch (error) {
    failures.push(String(error.stack || error));
  }
  failures.push(...window.pageErrors.map((text) => `console: ${text}`));
  console.log(`page-test: ${failures.length ? failures.join('; ') : 'passed'}.`);
})();
