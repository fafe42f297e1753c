// What run_page.py has written into the page: sizes, steps, arrays, histories, words.

export const page = JSON.parse(document.getElementById("data").textContent);
