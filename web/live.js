// The bar of a run that is watched: where it stands, and buttons that the run obeys.

import { told } from './chart.js';

const phases = { packing: 'packing the bed', 'spin-up': 'flow on the fixed bed', digging: 'digging', paused: 'paused' };

function duration(seconds) {
  const s = Math.round(seconds);
  if (s >= 3600) return `${Math.floor(s / 3600)} h ${String(Math.floor(s / 60) % 60).padStart(2, '0')} min`;
  return `${Math.floor(s / 60)}:${String(s % 60).padStart(2, '0')}`;
}

export class Live {
  constructor(token) {
    this.token = token;
    this.element = document.createElement('div');
    this.element.className = 'live';
    this.element.innerHTML = '<b class="pill">…</b><progress max="1" value="0"></progress><span class="told"></span><span class="grow"></span>'
      + '<button type="button" data-command="checkpoint">checkpoint</button><button type="button" data-command="pause">pause</button><button type="button" data-command="stop">stop</button><span class="answer" role="status"></span>';
    [this.pill, this.bar, this.told, this.answer] = ['.pill', 'progress', '.told', '.answer'].map((s) => this.element.querySelector(s));
    this.buttons = [...this.element.querySelectorAll('button')];
    for (const button of this.buttons) button.onclick = () => this.command(button.dataset.command);
  }

  async command(word) {
    if (word === 'stop' && !confirm('Stop this run? It writes a checkpoint first; livebed resume continues it.')) return;
    const answer = await fetch('command', { method: 'POST', headers: { 'X-Livebed-Token': this.token, 'Content-Type': 'text/plain' }, body: word })
      .catch(() => ({ ok: false, text: () => 'the server does not answer' }));
    this.answer.textContent = answer.ok ? `asked: ${word}` : await answer.text();
    setTimeout(() => { this.answer.textContent = ''; }, 4000);
  }

  /// status: of run.json; null when the run is not going on.
  show(status, summary, lastTime) {
    const going = status?.alive;
    const phase = going ? phases[status.phase] ?? status.phase : summary?.ended ? `ended: ${summary.ended}` : 'not going on';
    this.pill.textContent = phase;
    this.element.dataset.phase = going ? status.phase : 'ended';
    const t = going ? status.t_s : lastTime;
    this.bar.value = going ? (status.end_s > 0 ? Math.max(0, status.t_s) / status.end_s : 0) : 1;
    const words = [];
    if (going && status.phase !== 'packing') words.push(`t = ${told(t, 4)} of ${told(status.end_s, 4)} s`, `S/D = ${told(status.S_over_D, 3)}`);
    if (going && status.phase === 'digging' && status.speed > 0) words.push(`${told(status.speed, 2)} s/s`, `${duration(status.left_s)} left`);
    if (!going && !summary?.ended) words.push('its program is gone; livebed resume goes on');
    this.told.textContent = words.join(' · ');
    for (const button of this.buttons) {
      button.disabled = !going || status.phase === 'packing';
      if (button.dataset.command === 'pause' || button.dataset.command === 'go') {
        button.dataset.command = status?.phase === 'paused' ? 'go' : 'pause';
        button.textContent = status?.phase === 'paused' ? 'go on' : 'pause';
      }
    }
    document.title = `${going ? `${Math.round(100 * this.bar.value)} % ` : ''}${document.title.replace(/^\d+ % /, '')}`;
  }

  trouble(message) { this.told.textContent = message; }

  lost() {
    this.pill.textContent = 'no answer';
    this.element.dataset.phase = 'lost';
    this.told.textContent = 'the server has ended; what was read stays. livebed watch DIR serves the page again';
    for (const button of this.buttons) button.disabled = true;
  }
}
