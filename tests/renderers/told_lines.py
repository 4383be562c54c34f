"""told_lines.py FILE COMMAND…: starts a renderer, forwards every line in both directions, and logs each to the file:
> a request, < an answer."""
import subprocess
import sys


def main():
    file, *command = sys.argv[1:]
    with open(file, "a", encoding="utf-8") as told, \
            subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as renderer:
        for request in sys.stdin:
            told.write("> " + request)
            renderer.stdin.write(request)
            renderer.stdin.flush()
            if '"close"' in request:
                break
            answer = renderer.stdout.readline()
            told.write("< " + answer)
            told.flush()
            sys.stdout.write(answer)
            sys.stdout.flush()
        renderer.stdin.close()
        status = renderer.wait()
    sys.exit(status)


if __name__ == "__main__":
    main()
