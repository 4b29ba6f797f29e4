"""Generated drivers; see each module. Regenerate with `regscribe generate`."""
