// What the test needs of the SDK.
export { Client } from "@modelcontextprotocol/sdk/client/index.js";
export { StdioClientTransport } from "@modelcontextprotocol/sdk/client/stdio.js";
export { LATEST_PROTOCOL_VERSION } from "@modelcontextprotocol/sdk/types.js";
