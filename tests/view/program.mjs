// Starts the program itself for a test, and ends it.
import { spawn } from 'node:child_process';

const kEndMs = 20000;

/// Runs `nephroid view` with these arguments: {address, said(), stop()}. said() is what it
/// has written to standard error, stop() gives the exit status.
export async function startView(program, ...parameters) {
  const child = spawn(program, ['view', ...parameters, '--no-browser'],
    { stdio: ['ignore', 'ignore', 'pipe'] });
  const ended = new Promise((resolve) => { child.on('exit', resolve); });
  let said = '';
  const address = await new Promise((resolve, reject) => {
    child.stderr.on('data', (bytes) => {
      said += bytes;
      const line = said.match(/^(http\S+)\n/m);
      if (line) resolve(line[1]);
    });
    ended.then(() => reject(new Error(`${program} ended: ${said}`)));
  });
  const stop = async () => {
    child.kill('SIGTERM');
    const timer = setTimeout(() => child.kill('SIGKILL'), kEndMs);
    const status = await ended;
    clearTimeout(timer);
    return status;
  };
  return { address, said: () => said, stop };
}
