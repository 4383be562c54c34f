#!/usr/bin/env node
// three.js as a renderer that Gnomon drives: docs/renderer_protocol.md. README.md says how it is made to say what it does.
import { drive } from "../common/adapter.mjs";
import { engine } from "./engine.mjs";

drive(engine);
