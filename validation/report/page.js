'use strict';
(() => {
  const root = document.documentElement;

  // Light or dark: the reader's system decides until the button is used.
  const toggle = document.getElementById('theme');
  toggle.hidden = false;
  toggle.addEventListener('click', () => {
    const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
    root.dataset.theme = dark ? 'light' : 'dark';
  });

  // The first picture once more, beside the verdict.
  for (const hero of document.querySelectorAll('.hero')) {
    const source = document.getElementById(hero.dataset.from).querySelector('.frame');
    hero.prepend(source.cloneNode(true));
    hero.hidden = false;
  }

  // The slider is a real range input: mouse, touch and arrow keys all work.
  for (const slider of document.querySelectorAll('.slider')) {
    const input = slider.querySelector('input');
    const move = () => slider.style.setProperty('--at', input.value + '%');
    input.addEventListener('input', move);
    move();
  }

  // Tabs: one panel per target.
  for (const list of document.querySelectorAll('[role="tablist"]')) {
    const tabs = [...list.querySelectorAll('[role="tab"]')];
    const select = (tab, focus) => {
      for (const other of tabs) {
        const chosen = other === tab;
        other.setAttribute('aria-selected', chosen);
        other.tabIndex = chosen ? 0 : -1;
        document.getElementById(other.getAttribute('aria-controls')).hidden = !chosen;
      }
      if (focus) tab.focus();
    };
    tabs.forEach((tab, i) => {
      tab.addEventListener('click', () => select(tab, false));
      tab.addEventListener('keydown', (event) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (step) { event.preventDefault(); select(tabs[(i + step + tabs.length) % tabs.length], true); }
      });
    });
    select(tabs[0], false);
  }

  // The loupe: the same texels of both sides and of the class image, under the pointer.
  const loupe = document.createElement('div');
  loupe.className = 'loupe';
  loupe.setAttribute('aria-hidden', 'true');
  document.body.append(loupe);
  const TEXELS = 17, SCALE = 8;
  const show = (article, event, frame) => {
    const panel = article.querySelector('[role="tabpanel"]:not([hidden])');
    const images = [[article.dataset.left, panel.querySelector('.cpu')], [article.dataset.right, panel.querySelector('.gl')], ['class, enlarged', article.querySelector('.classes')]]
      .filter(([, image]) => image && image.naturalWidth);
    if (!images.length) return;
    const box = frame.getBoundingClientRect();
    const w = images[0][1].naturalWidth, h = images[0][1].naturalHeight;
    const x = Math.min(w - 1, Math.max(0, Math.floor((event.clientX - box.left) / box.width * w)));
    const y = Math.min(h - 1, Math.max(0, Math.floor((event.clientY - box.top) / box.height * h)));
    const step = Number(article.dataset.step);
    loupe.replaceChildren();
    const caption = document.createElement('p');
    caption.textContent = `texel (${x * step}, ${(h - 1 - y) * step})`;
    const row = document.createElement('div');
    for (const [name, image] of images) {
      const figure = document.createElement('figure');
      const canvas = document.createElement('canvas');
      canvas.width = canvas.height = TEXELS * SCALE;
      const context = canvas.getContext('2d');
      context.imageSmoothingEnabled = false;
      context.fillStyle = '#808080';
      context.fillRect(0, 0, canvas.width, canvas.height);
      const half = TEXELS >> 1;
      context.drawImage(image, x - half, y - half, TEXELS, TEXELS, 0, 0, canvas.width, canvas.height);
      context.strokeStyle = '#fff';
      context.lineWidth = 2;
      context.strokeRect(half * SCALE - 1, half * SCALE - 1, SCALE + 2, SCALE + 2);
      const label = document.createElement('figcaption');
      label.textContent = name;
      figure.append(canvas, label);
      row.append(figure);
    }
    loupe.append(caption, row);
    loupe.classList.add('on');
    const size = loupe.getBoundingClientRect();
    const left = event.clientX + 24 + size.width > innerWidth ? event.clientX - 24 - size.width : event.clientX + 24;
    const top = Math.min(innerHeight - size.height - 8, Math.max(8, event.clientY - size.height / 2));
    loupe.style.left = Math.max(4, left) + 'px';
    loupe.style.top = top + 'px';
  };
  for (const article of document.querySelectorAll('[data-step]')) {
    for (const frame of article.querySelectorAll('.frame')) {
      frame.addEventListener('pointermove', (event) => { if (event.pointerType === 'mouse') show(article, event, frame); });
      frame.addEventListener('pointerleave', () => loupe.classList.remove('on'));
    }
  }
  for (const film of document.querySelectorAll('.film')) {
    const pictures = film.querySelectorAll('figure');
    const slider = film.querySelector('input');
    const turn = () => pictures.forEach((picture, n) => { picture.hidden = n !== Number(slider.value); });
    slider.hidden = false;
    slider.addEventListener('input', turn);
    film.classList.add('playing');
    turn();
  }
})();
