#!/usr/bin/env node
// Lets Gnomon drive three.js (docs/renderer_protocol.md). README.md explains how.
import { drive } from "../common/adapter.mjs";
import { engine } from "./engine.mjs";

drive(engine);
