'use strict';
// Runs in the page, after it: does what a reader would, and logs "passed" or what failed. `window.pageErrors` was
// filled from before the page's own scripts on.
PageTest.run(async () => {
  const { expect, frame, settled, pixels, painted, different } = PageTest;
  const press = async (selector) => { document.querySelector(selector).click(); await frame(); await frame(); };

  const curves = () => [...document.querySelectorAll('#chart path.curve')];
  const hash = () => decodeURIComponent(location.hash);

  const run = JSON.parse(document.getElementById('run').textContent);
  const first = run.models[0];
  expect(document.querySelectorAll('#findings li').length === run.sentences.length && run.sentences.length > 0, 'sentences');
  expect(curves().length === first.curves.length, 'one curve a method');
  expect(curves().every((c) => c.getTotalLength() > 50), 'curves have length');
  expect(document.querySelectorAll('#chart path.ceiling').length > 0, 'ceilings');
  expect(document.querySelectorAll('#table tr').length > first.curves.length, 'table');

  const before = curves()[0].getAttribute('d');
  await press('#log');
  expect(curves()[0].getAttribute('d') !== before, 'the log toggle changes the curve');
  expect(hash().includes('log=0'), 'the log toggle is in the address');
  await press('#ceilings');
  expect(document.querySelectorAll('#chart path.ceiling').length === 0, 'ceilings can be hidden');
  const label = first.curves[1].label;
  await press(`#legend input[data-label="${label}"]`);
  expect(!curves().some((c) => c.dataset.label === label), 'a curve can be hidden');
  expect(hash().includes(`hide=${label}`), 'what is hidden is in the address');
  await press(`#legend input[data-label="${label}"]`);
  expect(curves().some((c) => c.dataset.label === label), 'and shown again');

  const chart = document.getElementById('chart'), box = chart.getBoundingClientRect();
  const dot = document.querySelector('#chart circle[fill]:not([fill="none"])');
  chart.onpointermove({ clientX: box.left + Number(dot.getAttribute('cx')), clientY: box.top + Number(dot.getAttribute('cy')) });
  expect(!document.getElementById('tip').hidden && /bytes/.test(document.getElementById('tip').textContent), 'a point tells its numbers');

  let saved = null;
  const make = URL.createObjectURL;
  URL.createObjectURL = (blob) => { saved = blob; return make.call(URL, blob); };
  await press('#csv');
  const rows = saved ? (await saved.text()).trim().split('\n') : [];
  expect(rows.length === 1 + first.curves.reduce((n, c) => n + c.points.length, 0), 'the CSV has every point that is shown');

  await settled(() => document.getElementById('view-message').hidden);
  await settled(() => painted(pixels()) > 0.05);
  const patches = pixels();
  expect(painted(patches) > 0.05, 'the surface is drawn');
  for (const kind of ['isolines', 'anisotropy', 'distance']) {
    await press(`#view-kinds button[data-value="${kind}"]`);
    await settled(() => different(patches, pixels()) > 0.01);
    expect(different(patches, pixels()) > 0.01, `${kind} looks different from patches`);
    expect(hash().includes(`colours=${kind}`), `${kind} is in the address`);
  }
  await press('#view-kinds button[data-value="shape"]');
  const whole = pixels(), budget = document.getElementById('budget');
  budget.value = 0;
  budget.dispatchEvent(new Event('input'));
  await settled(() => different(whole, pixels()) > 0.001);
  expect(different(whole, pixels()) > 0.001, 'fewer bytes decode to another surface');
  expect(/size=\d+/.test(hash()), 'the size is in the address');

  location.hash = '#colours=area&log=1';
  await frame();
  await frame();
  expect(document.querySelector('#view-kinds button[aria-pressed="true"]').dataset.value === 'area', 'an address sets the state');
  expect(document.getElementById('log').checked, 'all of it');
});
