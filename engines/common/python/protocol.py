"""Answers Gnomon's requests (docs/renderer_protocol.md) for an engine."""
import json
import os
import signal
import sys


class Refused(Exception):
    """A refusal of the request: a sentence, or one for each key."""

    @property
    def reason(self):
        return self.args[0]


class Requests:
    """Holds the open scene, and answers requests.

    `engine` has `hello()` and `draw(scene, order, frame)`, which return members of the answer, and `open(scene)`; each may
    raise Refused. `close()` ends the engine.
    """

    def __init__(self, engine):
        self.engine = engine
        self.scene = None

    def open(self, scene):
        self.scene = None
        if not os.path.isfile(scene["mesh"]["file"]):
            raise Refused(f"{scene['mesh']['file']} does not exist")
        self.engine.open(scene)
        self.scene = scene
        return {"ok": True}

    def draw(self, order, frame):
        if self.scene is None:
            raise Refused("no scene is open: send open before draw")
        return {"ok": True, **self.engine.draw(self.scene, order, frame)}

    def answer(self, request):
        try:
            if "hello" in request:
                return {"protocol": 1, **self.engine.hello()}
            if "open" in request:
                return self.open(request["open"])
            if "draw" in request:
                return self.draw(request["draw"], request["frame"])
            return {"error": "unknown request; known are hello, open, draw and close"}
        except Refused as refused:
            return {"error": refused.reason}


def take_standard_output():
    """The stream for answers. From now on, other output to standard output goes to standard error."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    return answers


def answer_all(engine, answers):
    requests = Requests(engine)
    for line in sys.stdin:
        request = json.loads(line)
        if "close" in request:
            return
        answers.write(json.dumps({"id": request["id"], **requests.answer(request)}) + "\n")
        answers.flush()


def read_options(words, known):
    """The value of each option; the first known one by default.

    @param known  values by option name.
    @throws ValueError  for an unknown option.
    """
    options = {name: values[0] for name, values in known.items()}
    allowed = {f"--{name}={value}": (name, value) for name, values in known.items() for value in values}
    for word in words:
        if word not in allowed:
            raise ValueError(f"unknown option {word}; known are {', '.join(allowed)}")
        name, value = allowed[word]
        options[name] = value
    return options


def serve(name, start):
    """Runs an adapter: answers requests until `close`, the end of input or a signal, then ends the engine.

    @param name   starts messages on standard error.
    @param start  returns the engine. OSError and ValueError, here or from requests, end the adapter with their message.
    @return  the exit status: 0, or 1 after a signal or a failure.
    """
    def end_by_signal(*_):
        sys.exit(1)

    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        signal.signal(number, end_by_signal)
    answers = take_standard_output()
    engine = None
    try:
        engine = start()
        answer_all(engine, answers)
        return 0
    except json.JSONDecodeError as problem:
        print(f"{name}: a request is not JSON: {problem}", file=sys.stderr)
    except (OSError, ValueError) as problem:
        print(f"{name}: {problem}", file=sys.stderr)
    finally:
        if engine is not None:
            engine.close()
    return 1
