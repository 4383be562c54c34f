/** Sends arrays of 32-bit floats to the adapter; returns their names. */
export async function post(frames) {
  for (const [name, values] of Object.entries(frames)) {
    const answer = await fetch(`../${name}`, { method: "POST", body: values });
    if (!answer.ok) throw new Error(`posting ${name}: status ${answer.status}`);
  }
  return Object.keys(frames);
}
