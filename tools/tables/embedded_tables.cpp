// Embeds the file that make_tables wrote into the program as read-only bytes: the compiler need not
// parse millions of numbers. src/core/spectra_data.cpp uses its symbol. cmake/tables.cmake sets
// NEPHROID_TABLES_FILE, the path of the file.

__asm__(
    ".pushsection .rodata\n"
    ".balign 64\n"
    ".global nephroid_data_tables\n"
    ".hidden nephroid_data_tables\n"
    ".type nephroid_data_tables, @object\n"
    "nephroid_data_tables:\n"
    ".incbin \"" NEPHROID_TABLES_FILE
    "\"\n"
    ".size nephroid_data_tables, . - nephroid_data_tables\n"
    ".popsection\n");
