"""How the window looks: colours, sizes, type, icons and the marks of kinds, all from here."""
