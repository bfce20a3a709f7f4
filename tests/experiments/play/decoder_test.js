'use strict';
// node decoder_test.js DECODER.JS DECODER.WASM GOLDEN: the module decodes the golden streams to the hashes that are kept
// of them (tests/coder/golden/golden.h), and survives damaged ones. Exit status 1 where it does not.
const fs = require('fs');
const [script, binary, golden] = process.argv.slice(2);
const text = fs.readFileSync(script, 'utf8');
const loadDecoder = new Function(`${text.slice(0, text.indexOf('// The decoder in a worker'))}; return loadDecoder;`)();

// FNV-1a over 64-bit words.
function hash(mesh, base) {
  let sum = 0xcbf29ce484222325n;
  const add = (bytes) => { for (const b of bytes) sum = BigInt.asUintN(64, (sum ^ BigInt(b)) * 0x100000001b3n); };
  const whole = (numbers) => add(new Uint8Array(BigInt64Array.from(numbers, BigInt).buffer));
  whole([mesh.level]);
  whole(base.faces);
  whole(mesh.creases);
  add(new Uint8Array(mesh.positions.buffer));
  return sum.toString(16).padStart(16, '0');
}

(async () => {
  const decoder = await loadDecoder(fs.readFileSync(binary));
  const kFinest = 10;
  let failures = 0;
  const lines = fs.readFileSync(`${golden}/hashes.txt`, 'utf8').trim().split('\n');
  for (const line of lines) {
    const [name, ...kept] = line.split(' ');
    const stream = fs.readFileSync(`${golden}/${name}`), handle = decoder.open(stream);
    [stream.length, Math.floor(stream.length / 2)].forEach((bytes, i) => {
      const mesh = decoder.decode(handle, bytes, kFinest), base = decoder.decode(handle, bytes, 0);
      if (hash(mesh, base) === kept[i]) return;
      console.log(`${name}: ${bytes} bytes decode to ${hash(mesh, base)}`);
      ++failures;
    });
    decoder.close(handle);
  }

  // Every answer to a damaged stream is a mesh or an error with its cause.
  const whole = fs.readFileSync(`${golden}/creases-corners.pgc`);
  let refused = 0;
  for (let k = 0; k < whole.length && k < 200; ++k) {
    const damaged = Buffer.from(whole);
    damaged[k] ^= 1 << (k % 8);
    try {
      const handle = decoder.open(damaged);
      decoder.decode(handle, damaged.length, kFinest);
      decoder.close(handle);
    } catch (error) {
      if (!/^(bad-stream|truncated): /.test(error.message)) throw error;
      ++refused;
    }
  }
  if (refused < 10) ++failures;
  console.log(`${lines.length} streams, ${refused} damaged ones refused, ${failures} failures`);
  process.exit(lines.length === 0 || failures > 0 ? 1 : 0);
})();
