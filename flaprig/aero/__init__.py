"""Air models as frozen settings, and prescribed motion through them."""
