'use strict';
// What tests of pages have in common. run_in_page (browser.sh) puts it before a test's script.
const PageTest = (() => {
  const failures = [];
  // The page draws in an animation frame; a timer alone may run out before it.
  const frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 20)));
  const share = (data, counts) => { let n = 0; for (let i = 0; i < data.length; i += 4) n += counts(i); return n / (data.length / 4); };
  return {
    expect: (condition, text) => { if (!condition) failures.push(text); },
    frame,
    settled: async (condition, frames = 100) => { for (let i = 0; i < frames && !condition(); ++i) await frame(); },
    // Of the 3D view.
    pixels() {
      const view = document.getElementById('view'), copy = document.createElement('canvas');
      copy.width = view.width;
      copy.height = view.height;
      const context = copy.getContext('2d');
      context.drawImage(view, 0, 0);
      return context.getImageData(0, 0, copy.width, copy.height).data;
    },
    painted: (data) => share(data, (i) => data[i + 3] > 0),
    different: (a, b) => share(a, (i) => Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) > 24),
    // Runs a test and logs "passed" or what failed, the page's own errors among it.
    async run(test) {
      try {
        await test();
      } catch (error) {
        failures.push(String(error.stack || error));
      }
      failures.push(...window.pageErrors.map((text) => `console: ${text}`));
      console.log(`page-test: ${failures.length ? failures.join('; ') : 'passed'}.`);
    },
  };
})();
