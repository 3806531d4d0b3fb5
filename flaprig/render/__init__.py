"""Pictures: which OpenGL library draws them on this machine."""
